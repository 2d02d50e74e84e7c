#include "tracking/simulation/triangle_beats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/detection/tone.h"
#include "signal/detection/tone_bound.h"
#include "signal/fourier/fft.h"
#include "signal/fourier/window.h"
#include "signal/fourier/window_figures.h"
#include "tracking/simulation/beat_waves.h"
#include "tracking/simulation/ramp_tones.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kPadding = 2;
constexpr double kThreshold = 20.0;    // of one channel, over the mean noise of a line: 13 dB
constexpr double kBendReach = 2.4;     // bins
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

// Sums over channels fluctuate less: the threshold is that of one channel for the sum.
double least_line(double channels) { return 1.0 + kThreshold / std::sqrt(channels); }

std::vector<double> peak_bins(const std::vector<double>& lines, std::size_t channels) {
  const double least = std::max(least_line(static_cast<double>(channels)),
                                kLeastLine * *std::max_element(lines.begin(), lines.end()));
  std::vector<double> bins;
  const std::size_t count = lines.size();
  for (std::size_t k = 0; k < count; ++k)
    if (lines[k] > least && lines[k] > lines[(k + count - 1) % count] &&
        lines[k] >= lines[(k + 1) % count])
      bins.push_back(static_cast<double>(k) / kPadding);
  return bins;
}

// Where a ramp has the beats of coarse places, and how much they bend.
std::vector<BentPeak> places_of(const std::vector<signal::RangeSpeed>& coarse,
                                const signal::TriangleModel& model, bool up, double bin_Hz) {
  std::vector<BentPeak> places;
  for (const signal::RangeSpeed& place : coarse) {
    const signal::BeatPair beats = predict(model, place);
    // d2 phi / dt2 = 4 pi S tau', over the ramp.
    const double drift_Hz = 4.0 * (up ? 1.0 : -1.0) * model.slope_Hz_per_s *
                            place.radial_speed_mps / core::kSpeedOfLight_mps * model.ramp_s;
    places.push_back({(up ? beats.up_Hz : beats.down_Hz) / bin_Hz, drift_Hz / bin_Hz});
  }
  return places;
}

std::vector<NearPlaces> near_places(const std::vector<RampTone>& tones,
                                    const std::vector<BentPeak>& places,
                                    const std::vector<signal::RangeSpeed>& coarse, double count) {
  std::vector<NearPlaces> result;
  for (const RampTone& one : tones) {
    NearPlaces near{std::numeric_limits<double>::infinity(), one.bent.curvature_bins,
                    one.bent.curvature_bins};
    double nearest = kSeenReach_bins;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double apart = bins_apart(one.bent.tone.bin, places[i].bin, count);
      if (apart >= kSeenReach_bins || !(coarse[i].range_m > 0.0)) continue;
      near.least_bend_bins = std::min(near.least_bend_bins, places[i].curvature_bins);
      near.most_bend_bins = std::max(near.most_bend_bins, places[i].curvature_bins);
      if (apart < nearest) near.range_m = coarse[i].range_m;
      nearest = std::min(nearest, apart);
    }
    result.push_back(near);
  }
  return result;
}

// What the bend c of the other one of two tones leaves, d bins away: pi c (t^2 - 1/12) of its
// amplitude, which moves a tone of the same power by up to c / (2 pi d); rms over their phases, as
// measured. About as much of its amplitude is left beside the tone's.
double bend_bins(const RampTone& one, const std::vector<RampTone>& all, double count) {
  double worst = 0.0;
  for (const RampTone& other : all) {
    const double apart = bins_apart(one.bent.tone.bin, other.bent.tone.bin, count);
    if (&other == &one || !other.jointly || apart >= kBendReach) continue;
    worst = std::max(worst, std::sqrt(other.bent.tone.power / one.bent.tone.power) *
                                other.other_bends / (4.0 * core::kPi * std::max(apart, 0.3)));
  }
  return worst;
}

// Of a tone sought under the window, over one sought without: variance of its place and noise of its
// amplitude.
struct WindowCost {
  double variance_ratio = 1.0, noise_ratio = 1.0;
};

// What else than noise leaves the places of tones unsure.
std::vector<double> unknown_bins_of(const std::vector<RampTone>& found, double count) {
  std::vector<double> bins;
  for (const RampTone& one : found)
    bins.push_back(std::hypot(bend_bins(one, found, count), one.bent.unsettled_bins));
  return bins;
}

std::vector<Beat> beats_of(const std::vector<RampTone>& found,
                           const std::vector<double>& unknown_bins, std::size_t samples,
                           double bin_Hz, double noise_W, const WindowCost& window) {
  const auto count = static_cast<double>(samples);
  std::vector<signal::Tone> tones;
  for (const RampTone& one : found) tones.push_back(one.bent.tone);
  const std::vector<signal::ToneBound> bounds = signal::tone_bounds(tones, samples, noise_W);
  std::vector<Beat> beats;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const signal::Tone& tone = found[i].bent.tone;
    // A bent tone's place is that at the middle sample, half a sample before the middle of the ramp.
    const double at_middle = tone.bin + 0.5 * found[i].bent.curvature_bins / count;
    const double bin = at_middle - count * std::floor((at_middle + 0.5 * count) / count);
    const WindowCost cost = found[i].jointly ? WindowCost{} : window;
    const double ratio = count * tone.power / noise_W, bend = bend_bins(found[i], found, count);
    // What cannot be told is told to a bin and to a third of a beam.
    const double sigma_bins = std::min(
        1.0,
        std::hypot(std::sqrt(cost.variance_ratio * bounds[i].variance_bins2), unknown_bins[i]));
    const double noise_ratio =
        std::min(std::max(1.0, ratio / 2.0),
                 cost.noise_ratio * bounds[i].amplitude_noise_ratio + bend * bend * ratio);
    const bool in_turn =
        !found[i].jointly && std::any_of(found.begin(), found.end(), [&](const RampTone& other) {
          return &other != &found[i] &&
                 bins_apart(other.bent.tone.bin, tone.bin, count) < kTouching_bins;
        });
    beats.push_back({bin * bin_Hz, sigma_bins * bin_Hz, in_turn ? 2.0 * kStill_bins : 0.0, ratio,
                     tone.amplitudes, noise_ratio, found[i].peak});
  }
  return beats;
}

}  // namespace

SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W,
                            const std::vector<signal::RangeSpeed>& coarse,
                            const ReceiverLine& line) {
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
  WindowCost cost;
  if (!alone) {
    const signal::WindowFigures figures = signal::window_figures(weights);
    cost = {figures.variance_ratio, figures.noise_bandwidth_bins};
  }
  // The first chirp is the ramp up where its middle comes before the turnaround.
  const int up = model.up_middle_s < 0.0 ? 0 : 1;
  const double bin_Hz = sample_rate_Hz / count;
  std::vector<Beat> beats[2];
  core::parallel_for(2, [&](std::size_t ramp) {
    const bool is_up = static_cast<int>(ramp) == up;
    const std::vector<BentPeak> places = places_of(coarse, model, is_up, bin_Hz);
    const auto channels = static_cast<double>(records[ramp].size());
    const double least_power = cost.noise_ratio * channels * least_line(channels) * noise_W / count;
    const std::vector<RampTone> found =
        ramp_tones(records[ramp], bins[ramp], places, alone ? std::vector<double>{} : weights,
                   noise_W, least_power);
    const double sweep = (is_up ? 1.0 : -1.0) * model.slope_Hz_per_s * count / sample_rate_Hz /
                         model.centre_frequency_Hz;
    const std::vector<double> unknown_bins = unknown_bins_of(found, count);
    beats[ramp] = by_direction(
        {records[ramp], found, noise_W, bin_Hz, sweep, near_places(found, places, coarse, count),
         unknown_bins},
        line, beats_of(found, unknown_bins, records[ramp].front().size(), bin_Hz, noise_W, cost));
  });
  return {std::move(beats[up]), std::move(beats[1 - up])};
}

}  // namespace fanbeam::tracking
