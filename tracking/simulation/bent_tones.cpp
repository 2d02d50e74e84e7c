#include "tracking/simulation/bent_tones.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.h"

namespace fanbeam::tracking {
namespace {

constexpr int kMostTurns = 12;
constexpr double kOwnPeak = 1.0;  // bins
// Bins within which main lobes overlap. Beyond, side lobes alone pull, and one turn takes that off to a thousandth.
constexpr double kTouching = 3.5;

double bend_turns(double curvature_bins, std::size_t n, std::size_t count) {
  const double t =
      (static_cast<double>(n) - 0.5 * static_cast<double>(count - 1)) / static_cast<double>(count);
  return 0.5 * curvature_bins * t * t;
}

signal::Tone refined(const signal::ToneRecords& records, const BentPeak& near,
                     const std::vector<double>& weights) {
  if (near.curvature_bins == 0.0) return signal::refined_tone(records, near.bin, weights);
  signal::ToneRecords straight = records;
  const std::size_t count = records.front().size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::complex<double> phasor =
        std::polar(1.0, -2.0 * core::kPi * bend_turns(near.curvature_bins, n, count));
    for (auto& record : straight) record[n] *= phasor;
  }
  return signal::refined_tone(straight, near.bin, weights);
}

bool touches(const std::vector<BentPeak>& peaks, std::size_t one, double count) {
  for (std::size_t i = 0; i < peaks.size(); ++i)
    if (i != one && bins_apart(peaks[i].bin, peaks[one].bin, count) < kTouching) return true;
  return false;
}

}  // namespace

double bins_apart(double a, double b, double count) {
  return std::abs(std::remainder(a - b, count));
}

void add(const BentTone& bent, double times, signal::ToneRecords& records) {
  const std::size_t count = records.front().size();
  for (std::size_t n = 0; n < count; ++n) {
    const double turns = bent.tone.bin * static_cast<double>(n) / static_cast<double>(count) +
                         bend_turns(bent.curvature_bins, n, count);
    const std::complex<double> phasor = times * std::polar(1.0, 2.0 * core::kPi * turns);
    for (std::size_t channel = 0; channel < records.size(); ++channel)
      records[channel][n] += bent.tone.amplitudes[channel] * phasor;
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
