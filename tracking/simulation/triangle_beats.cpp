#include "tracking/simulation/triangle_beats.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/detection/tone.h"
#include "signal/detection/two_tones.h"
#include "signal/fourier/fft.h"
#include "signal/fourier/window.h"
#include "signal/fourier/window_figures.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kPadding = 2;
constexpr double kThreshold = 20.0;  // 13 dB over the mean noise of a line
constexpr double kTouching = 3.0;    // bins between peaks whose main lobes do
constexpr double kStill = 3e-4;      // bins: 0.2 mm
constexpr int kMostSweeps = 12;
constexpr double kLeastLine = 3.2e-6;  // -55 dB: over the side lobes of the strongest

signal::ToneRecords records_of(const signal::FloatCube& samples, int chirp) {
  signal::ToneRecords records;
  for (int channel = 0; channel < samples.shape.channels; ++channel) {
    const auto* first = &samples.at(channel, chirp, 0);
    records.emplace_back(first, first + samples.shape.samples);
  }
  return records;
}

// Power of each line of the padded, windowed spectrum, over that of noise alone.
std::vector<double> lines_of(const signal::ToneRecords& records, const std::vector<double>& weights,
                             double noise_W) {
  std::vector<double> lines(kPadding * weights.size(), 0.0);
  double squares = 0.0;
  for (const double weight : weights) squares += weight * weight;
  for (const auto& record : records) {
    std::vector<std::complex<double>> padded(lines.size());
    for (std::size_t n = 0; n < record.size(); ++n) padded[n] = record[n] * weights[n];
    const auto spectrum = signal::spectrum(std::move(padded));
    for (std::size_t k = 0; k < lines.size(); ++k) lines[k] += std::norm(spectrum[k]);
  }
  for (double& line : lines) line /= squares * noise_W * static_cast<double>(records.size());
  return lines;
}

std::vector<double> peak_bins(const std::vector<double>& lines, std::size_t channels) {
  // Sums over channels fluctuate less: the threshold is that of one channel for the sum.
  const double least = std::max(1.0 + kThreshold / std::sqrt(static_cast<double>(channels)),
                                kLeastLine * *std::max_element(lines.begin(), lines.end()));
  std::vector<double> bins;
  const std::size_t count = lines.size();
  for (std::size_t k = 0; k < count; ++k)
    if (lines[k] > least && lines[k] > lines[(k + count - 1) % count] &&
        lines[k] >= lines[(k + 1) % count])
      bins.push_back(static_cast<double>(k) / kPadding);
  return bins;
}

// Bins of 0 and of `count` are one.
double bins_apart(double a, double b, double count) {
  return std::abs(std::remainder(a - b, count));
}

// `times` -1 takes it away.
void add(const signal::Tone& tone, double times, signal::ToneRecords& records) {
  const std::size_t count = records.front().size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::complex<double> phasor = std::polar(
        1.0, 2.0 * core::kPi * tone.bin * static_cast<double>(n) / static_cast<double>(count));
    for (std::size_t channel = 0; channel < records.size(); ++channel)
      records[channel][n] += times * tone.amplitudes[channel] * phasor;
  }
}

// Tones of all peaks. Those whose main lobes touch are sought in turn, each in what the others leave
// (J. Li, P. Stoica, IEEE Trans. SP-44, 1996), until none moves any more.
std::vector<signal::Tone> tones_of(const signal::ToneRecords& records,
                                   const std::vector<double>& bins,
                                   const std::vector<double>& weights) {
  const auto count = static_cast<double>(records.front().size());
  std::vector<signal::Tone> tones;
  for (const double near : bins) tones.push_back(signal::refined_tone(records, near, weights));
  std::vector<bool> lost(tones.size(), false);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < tones.size(); ++i) {
      signal::ToneRecords rest;
      for (std::size_t j = 0; j < tones.size(); ++j) {
        if (j == i || lost[i] || bins_apart(bins[i], bins[j], count) > kTouching) continue;
        if (rest.empty()) rest = records;
        add(tones[j], -1.0, rest);
      }
      if (rest.empty()) continue;
      signal::Tone tone = signal::refined_tone(rest, tones[i].bin, weights);
      // One that leaves its peak has none of its own.
      lost[i] = bins_apart(tone.bin, bins[i], count) > 1.0;
      if (lost[i]) continue;
      furthest = std::max(furthest, bins_apart(tone.bin, tones[i].bin, count));
      tones[i] = std::move(tone);
    }
    if (furthest < kStill) break;
  }
  return tones;
}

// Where a ramp has the beat of a coarse place, and how much it bends.
struct Hint {
  double bin = 0.0, curvature_bins = 0.0;
};

std::vector<Hint> hints_of(const std::vector<signal::RangeSpeed>& coarse,
                           const signal::TriangleModel& model, bool up, double bin_Hz) {
  std::vector<Hint> hints;
  for (const signal::RangeSpeed& place : coarse) {
    const signal::BeatPair beats = predict(model, place);
    // d2 phi / dt2 = 4 pi S tau', over the ramp.
    const double drift_Hz = 4.0 * (up ? 1.0 : -1.0) * model.slope_Hz_per_s *
                            place.radial_speed_mps / core::kSpeedOfLight_mps * model.ramp_s;
    hints.push_back({(up ? beats.up_Hz : beats.down_Hz) / bin_Hz, drift_Hz / bin_Hz});
  }
  return hints;
}

constexpr double kHintReach = 2.5;  // bins

const Hint* nearest_hint(const std::vector<Hint>& hints, double bin, double count) {
  const Hint* best = nullptr;
  for (const Hint& hint : hints)
    if (bins_apart(hint.bin, bin, count) < kHintReach &&
        (best == nullptr || bins_apart(hint.bin, bin, count) < bins_apart(best->bin, bin, count)))
      best = &hint;
  return best;
}

// The tones of a ramp as beats, those apart that make one peak.
std::vector<Beat> beats_of(const signal::ToneRecords& records,
                           const std::vector<signal::Tone>& tones, const std::vector<Hint>& hints,
                           double bin_Hz, double noise_W) {
  const auto count = static_cast<double>(records.front().size());
  signal::ToneRecords rest = records;  // without all tones
  for (const signal::Tone& tone : tones) add(tone, -1.0, rest);
  std::vector<Beat> beats;
  const auto put = [&](const signal::Tone& tone, std::size_t peak) {
    const double bin = tone.bin - count * std::floor((tone.bin + 0.5 * count) / count);
    beats.push_back(
        {bin * bin_Hz, count * tone.power / noise_W, tone.amplitudes, static_cast<int>(peak)});
  };
  for (std::size_t i = 0; i < tones.size(); ++i) {
    std::optional<std::pair<signal::Tone, signal::Tone>> two;
    if (const Hint* hint = nearest_hint(hints, tones[i].bin, count)) {
      signal::ToneRecords own = rest;
      add(tones[i], 1.0, own);
      two = signal::two_tones(own, tones[i].bin, hint->curvature_bins, noise_W);
    }
    if (two) {
      put(two->first, i);
      put(two->second, i);
    } else {
      put(tones[i], i);
    }
  }
  return beats;
}

}  // namespace

SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W,
                            const std::vector<signal::RangeSpeed>& coarse) {
  const int count = samples.shape.samples;
  // The periodic form: with the symmetric one's ends six cars take 74 ms a scan instead of 28.
  const auto weights =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, count);
  signal::ToneRecords records[2];
  std::vector<double> bins[2];
  core::parallel_for(2, [&](std::size_t ramp) {
    records[ramp] = records_of(samples, static_cast<int>(ramp));
    bins[ramp] = peak_bins(lines_of(records[ramp], weights, noise_W), records[ramp].size());
  });
  const bool alone = bins[0].size() == 1 && bins[1].size() == 1;
  SampledBeats result;
  if (!alone) result.variance_ratio = signal::window_figures(weights).variance_ratio;
  std::vector<signal::Tone> tones[2];
  core::parallel_for(2, [&](std::size_t ramp) {
    tones[ramp] = tones_of(records[ramp], bins[ramp], alone ? std::vector<double>{} : weights);
  });
  // The first chirp is the ramp up where its middle comes before the turnaround.
  const int up = model.up_middle_s < 0.0 ? 0 : 1;
  const double bin_Hz = sample_rate_Hz / count;
  std::vector<Beat> beats[2];
  core::parallel_for(2, [&](std::size_t ramp) {
    const bool is_up = static_cast<int>(ramp) == up;
    const auto hints = hints_of(coarse, model, is_up, bin_Hz);
    beats[ramp] = beats_of(records[ramp], tones[ramp], hints, bin_Hz, noise_W);
  });
  result.up = std::move(beats[up]);
  result.down = std::move(beats[1 - up]);
  return result;
}

}  // namespace fanbeam::tracking
