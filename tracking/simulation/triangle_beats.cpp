#include "tracking/simulation/triangle_beats.h"

#include <algorithm>
#include <cmath>

#include "signal/detection/tone.h"
#include "signal/fourier/fft.h"
#include "signal/fourier/window.h"
#include "signal/fourier/window_figures.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kPadding = 2;
constexpr double kThreshold = 20.0;     // 13 dB over the mean noise of a line
constexpr double kLeastShare = 3.2e-6;  // -55 dB: over the side lobes of the strongest

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
                                kLeastShare * *std::max_element(lines.begin(), lines.end()));
  std::vector<double> bins;
  const std::size_t count = lines.size();
  for (std::size_t k = 0; k < count; ++k)
    if (lines[k] > least && lines[k] > lines[(k + count - 1) % count] &&
        lines[k] >= lines[(k + 1) % count])
      bins.push_back(static_cast<double>(k) / kPadding);
  return bins;
}

}  // namespace

SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W) {
  const int count = samples.shape.samples;
  const auto weights =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, count);
  const signal::ToneRecords records[] = {records_of(samples, 0), records_of(samples, 1)};
  std::vector<double> bins[2];
  for (int ramp = 0; ramp < 2; ++ramp)
    bins[ramp] = peak_bins(lines_of(records[ramp], weights, noise_W), records[ramp].size());
  const bool alone = bins[0].size() == 1 && bins[1].size() == 1;
  SampledBeats result;
  if (!alone) result.variance_ratio = signal::window_figures(weights).variance_ratio;
  // The first chirp is the ramp up where its middle comes before the turnaround.
  const int up = model.up_middle_s < 0.0 ? 0 : 1;
  for (int ramp = 0; ramp < 2; ++ramp)
    for (const double near : bins[ramp]) {
      const signal::Tone tone =
          signal::refined_tone(records[ramp], near, alone ? std::vector<double>{} : weights);
      const double half = 0.5 * count;
      const double bin = tone.bin - count * std::floor((tone.bin + half) / count);
      (ramp == up ? result.up : result.down)
          .push_back({bin * sample_rate_Hz / count, count * tone.power / noise_W});
    }
  return result;
}

}  // namespace fanbeam::tracking
