#include "tracking/simulation/bent_tones.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.h"

namespace fanbeam::tracking {
namespace {

constexpr int kMostTurns = 12;
constexpr double kTolerance_bins = 1e-7;
constexpr double kStraight_bins = 1e-4;  // a bend that moves nothing
constexpr double kOwnPeak = 1.0;         // bins

// exp(j 2 pi (b n / N + c t^2 / 2)), each from the one before: the step turns by the same at every
// sample.
std::vector<std::complex<double>> phasors_of(double bin, double curvature_bins, std::size_t count) {
  const auto n = static_cast<double>(count);
  const double first_t = -0.5 * (n - 1.0) / n;
  const auto turned = [](double turns) {
    return std::polar(1.0, 2.0 * core::kPi * std::remainder(turns, 1.0));
  };
  std::complex<double> phasor = turned(0.5 * curvature_bins * first_t * first_t);
  std::complex<double> step =
      turned(bin / n + 0.5 * curvature_bins * (2.0 * first_t + 1.0 / n) / n);
  const std::complex<double> turn = turned(curvature_bins / (n * n));
  std::vector<std::complex<double>> phasors;
  phasors.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    phasors.push_back(phasor);
    phasor *= step;
    step *= turn;
  }
  return phasors;
}

signal::Tone refined(const signal::ToneRecords& records, const BentPeak& near,
                     const std::vector<double>& weights) {
  if (std::abs(near.curvature_bins) < kStraight_bins)
    return signal::refined_tone(records, near.bin, weights, kTolerance_bins);
  signal::ToneRecords straight = records;
  const std::size_t count = records.front().size();
  const auto phasors = phasors_of(0.0, -near.curvature_bins, count);
  for (auto& record : straight)
    for (std::size_t n = 0; n < count; ++n) record[n] *= phasors[n];
  return signal::refined_tone(straight, near.bin, weights, kTolerance_bins);
}

bool touches(const std::vector<BentPeak>& peaks, std::size_t one, double count) {
  for (std::size_t i = 0; i < peaks.size(); ++i)
    if (i != one && bins_apart(peaks[i].bin, peaks[one].bin, count) < kTouching_bins) return true;
  return false;
}

}  // namespace

double bins_apart(double a, double b, double count) {
  return std::abs(std::remainder(a - b, count));
}

void add(const BentTone& bent, double times, signal::ToneRecords& records) {
  const auto phasors = phasors_of(bent.tone.bin, bent.curvature_bins, records.front().size());
  for (std::size_t channel = 0; channel < records.size(); ++channel) {
    const std::complex<double> amplitude = times * bent.tone.amplitudes[channel];
    for (std::size_t n = 0; n < phasors.size(); ++n) records[channel][n] += amplitude * phasors[n];
  }
}

std::vector<BentTone> tones_in_turn(const signal::ToneRecords& records,
                                    const std::vector<BentPeak>& peaks,
                                    const std::vector<double>& weights) {
  const auto count = static_cast<double>(records.front().size());
  const auto left = [&](const signal::Tone& tone, const BentPeak& peak) {
    return bins_apart(tone.bin, peak.bin, count) > kOwnPeak;
  };
  std::vector<BentTone> tones;
  for (const BentPeak& peak : peaks) {
    tones.push_back({refined(records, peak, weights), peak.curvature_bins});
    tones.back().lost = left(tones.back().tone, peak);
  }
  if (tones.size() < 2) return tones;
  signal::ToneRecords rest = records;
  for (const BentTone& bent : tones)
    if (!bent.lost) add(bent, -1.0, rest);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < tones.size(); ++i) {
      BentTone& own = tones[i];
      // Without the others one that was pulled off its peak may have a place there.
      if (turn > 0 && (own.lost || !touches(peaks, i, count))) continue;
      if (!own.lost) add(own, 1.0, rest);
      const double from_bin = own.lost ? peaks[i].bin : own.tone.bin;
      signal::Tone tone = refined(rest, {from_bin, own.curvature_bins}, weights);
      own.lost = left(tone, peaks[i]);
      if (own.lost) continue;
      const double move = bins_apart(tone.bin, from_bin, count);
      furthest = std::max(furthest, move);
      own.unsettled_bins = move < kStill_bins || !touches(peaks, i, count) ? 0.0 : 10.0 * move;
      own.tone = std::move(tone);
      add(own, -1.0, rest);
    }
    if (furthest < kStill_bins) break;
  }
  return tones;
}

}  // namespace fanbeam::tracking
