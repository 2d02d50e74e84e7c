#include "tracking/simulation/measurement_simulator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/constants.h"
#include "core/errors.h"
#include "core/number_range.h"
#include "signal/pairing/ghost_free.h"
#include "signal/waveform/factories.h"
#include "tracking/simulation/simulation_private.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kFalseCells = 1U << 20U;  // beyond any target's number

std::vector<Seen> seen_targets(const core::HighwayScenario& scenario,
                               const core::HighwayRadar& radar, const SimulationSettings& settings,
                               const Draws& draws, int frame) {
  std::vector<Seen> result;
  for (std::size_t i = 0; i < scenario.targets.size(); ++i) {
    const core::HighwayTarget& target = scenario.targets[i];
    const core::HighwayTruth truth =
        truth_at(target, scenario.radar_speed_mps, radar, frame * radar.frame_s);
    const double section_m2 = target.cross_section_m2 * draws.fluctuation(target.fluctuation, i);
    if (!truth.in_view || is_suppressed(target, truth.time_s) || !(section_m2 > 0.0) ||
        draws.uniform(i, 8) > settings.detection_probability)
      continue;
    const MeasurementBound bound =
        measurement_bound(radar, section_m2, truth.range_m, truth.azimuth_rad);
    if (bound.signal_to_noise < kLeastSignalToNoise) continue;
    result.push_back({truth.range_m, truth.range_rate_mps,
                      truth.azimuth_rad + bound.azimuth_sigma_rad * draws.normal(i, 0)[0],
                      bound.signal_to_noise, bound});
  }
  return result;
}

// Of these beats, in the order of frequency, those that are closer become one.
void add_merged(const Peaks& beats, const std::vector<std::size_t>& order, double closer_than_Hz,
                Peaks& peaks) {
  for (std::size_t i = 0; i < order.size();) {
    double power = 0.0, sum_Hz = 0.0, sum_rad = 0.0, sum_rad2 = 0.0;
    std::size_t end = i;
    do {
      const std::size_t one = order[end++];
      power += beats.power[one];
      sum_Hz += beats.power[one] * beats.Hz[one];
      sum_rad += beats.power[one] * beats.azimuth_rad[one];
      sum_rad2 += beats.power[one] * beats.azimuth_rad[one] * beats.azimuth_rad[one];
    } while (end < order.size() &&
             beats.Hz[order[end]] - beats.Hz[order[end - 1]] < closer_than_Hz);
    peaks.Hz.push_back(sum_Hz / power);
    peaks.azimuth_rad.push_back(sum_rad / power);
    peaks.power.push_back(power);
    // Two beats of one strength, evenly up to `closer_than_Hz` apart: (d / 2)^2 is a twelfth of its
    // square on average.
    const bool lone = end == i + 1;
    peaks.spread_Hz.push_back(lone ? 0.0 : closer_than_Hz / std::sqrt(12.0));
    peaks.spread_rad.push_back(
        lone ? 0.0 : std::sqrt(std::max(0.0, sum_rad2 / power - std::pow(sum_rad / power, 2))));
    i = end;
  }
}

// How near beats merge: in bins, and in the sine of their azimuths for the ratio of the weaker one.
struct Cell {
  double bins;
  std::function<double(double)> direction;
};

Peaks merged(const Peaks& beats, double closer_than_Hz, const Cell& cell) {
  std::vector<std::size_t> order(beats.Hz.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto across = [&](std::size_t i) { return std::sin(beats.azimuth_rad[i]); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return across(a) < across(b); });
  Peaks peaks;
  for (auto first = order.begin(); first != order.end();) {
    const auto apart = [&](std::size_t a, std::size_t b) {
      return across(b) - across(a) >= cell.direction(std::min(beats.power[a], beats.power[b]));
    };
    auto last = std::adjacent_find(first, order.end(), apart);
    if (last != order.end()) ++last;
    std::vector<std::size_t> group(first, last);
    std::sort(group.begin(), group.end(),
              [&](std::size_t a, std::size_t b) { return beats.Hz[a] < beats.Hz[b]; });
    add_merged(beats, group, closer_than_Hz, peaks);
    first = last;
  }
  return peaks;
}

// `later_s`: from the frame's time to the triangle's turnaround.
RampPeaks peaks_of(const signal::TriangleModel& model, double later_s,
                   const std::vector<Seen>& targets, const Cell& cell, double bound_ramp_s,
                   const Draws& draws, std::uint32_t draw) {
  RampPeaks beats;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Seen& target = targets[i];
    const signal::BeatPair pair =
        signal::predict(model, {target.range_m + target.rate_mps * later_s, target.rate_mps});
    const double ratio = target.bound.signal_to_noise * model.ramp_s / bound_ramp_s;
    const double sigma_Hz = std::sqrt(6.0 / ratio) / (2.0 * core::kPi * model.ramp_s);
    const auto noise = draws.normal(i, draw);
    const double beat_Hz[] = {pair.up_Hz + sigma_Hz * noise[0], pair.down_Hz + sigma_Hz * noise[1]};
    for (Peaks* side : {&beats.up, &beats.down}) {
      side->Hz.push_back(beat_Hz[side == &beats.up ? 0 : 1]);
      side->azimuth_rad.push_back(target.azimuth_rad);
      side->power.push_back(target.power);
    }
  }
  const double closer_than_Hz = cell.bins * model.bin_Hz();
  return {merged(beats.up, closer_than_Hz, cell), merged(beats.down, closer_than_Hz, cell)};
}

std::size_t nearest(const std::vector<double>& values, double to) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::abs(values[i] - to) < std::abs(values[best] - to)) best = i;
  return best;
}

void add_false(const core::HighwayRadar& radar, const SimulationSettings& settings,
               const Draws& draws, std::vector<RadarMeasurement>& measurements) {
  // Poisson by products of uniform numbers.
  const double limit = std::exp(-settings.false_per_frame);
  double product = 1.0;
  for (std::size_t i = 0;; ++i) {
    product *= draws.uniform(kFalseCells + i, 0, 0);
    if (product <= limit) return;
    RadarMeasurement one;
    one.range_m = radar.most_range_m * draws.uniform(kFalseCells + i, 0, 1);
    one.range_rate_mps =
        settings.most_speed_mps * (2.0 * draws.uniform(kFalseCells + i, 0, 2) - 1.0);
    one.azimuth_rad = radar.most_azimuth_rad * (2.0 * draws.uniform(kFalseCells + i, 0, 3) - 1.0);
    one.range_sigma_m = one.range_rate_sigma_mps = 0.02;
    one.azimuth_sigma_rad = 0.005;
    measurements.push_back(one);
  }
}

void check(const SimulationSettings& settings) {
  core::require_range("detection_probability", settings.detection_probability, {0.0, 1.0});
  core::require_range("false_per_frame", settings.false_per_frame, {0.0, 500.0});
}

}  // namespace

double Draws::fluctuation(core::Swerling model, std::size_t target) const {
  const double a = -std::log(uniform(target, 9, 0)), b = -std::log(uniform(target, 9, 1));
  if (model == core::Swerling::case1 || model == core::Swerling::case2) return a;
  if (model == core::Swerling::case3 || model == core::Swerling::case4) return 0.5 * (a + b);
  return 1.0;
}

double ramp_of(Scheme scheme, const core::HighwayWaveforms& waveforms) {
  switch (scheme) {
    case Scheme::triangle:
    case Scheme::sorted_triangle:
      return waveforms.triangle_ramp_s;
    case Scheme::two_slopes:
      return waveforms.two_slopes_ramp_s[0];
    case Scheme::two_stage:
      return waveforms.fine_ramp_s;
    case Scheme::coded:
      return waveforms.coded_ramp_s;
  }
  throw core::InternalError("unknown scheme");
}

double length_of(Scheme scheme, const core::HighwayWaveforms& waveforms) {
  switch (scheme) {
    case Scheme::triangle:
    case Scheme::sorted_triangle:
      return waveforms.triangle_s();
    case Scheme::two_slopes:
      return waveforms.two_slopes_s();
    case Scheme::two_stage:
      return waveforms.two_stage_s();
    case Scheme::coded:
      return waveforms.coded_s();
  }
  throw core::InternalError("unknown scheme");
}

PairOfPeaks peaks_at(const signal::TriangleModel& model, const RampPeaks& peaks,
                     const signal::RangeSpeed& place) {
  const signal::BeatPair beats = signal::predict(model, place);
  return {nearest(peaks.up.Hz, beats.up_Hz), nearest(peaks.down.Hz, beats.down_Hz)};
}

void state_spread(const signal::TriangleModel& model, const RampPeaks& peaks,
                  const PairOfPeaks& pair, RadarMeasurement& measurement) {
  const signal::BeatPair beats{peaks.up.Hz[pair.up], peaks.down.Hz[pair.down]};
  const signal::RangeSpeed place = solve(model, beats);
  const auto add = [&](double up_Hz, double down_Hz) {
    const signal::RangeSpeed moved = solve(model, {beats.up_Hz + up_Hz, beats.down_Hz + down_Hz});
    measurement.range_systematic_m =
        std::hypot(measurement.range_systematic_m, moved.range_m - place.range_m);
    measurement.range_rate_systematic_mps = std::hypot(
        measurement.range_rate_systematic_mps, moved.radial_speed_mps - place.radial_speed_mps);
  };
  add(peaks.up.spread_Hz[pair.up], 0.0);
  add(0.0, peaks.down.spread_Hz[pair.down]);
}

RadarMeasurement measured_pair(const signal::TriangleModel& model, const RampPeaks& peaks,
                               const signal::RangeSpeed& place, const core::HighwayRadar& radar) {
  const PairOfPeaks pair = peaks_at(model, peaks, place);
  const auto [up, down] = pair;
  const double azimuth_rad = 0.5 * (peaks.up.azimuth_rad[up] + peaks.down.azimuth_rad[down]);
  // The bound of a cross-section that would give this power.
  const double ratio = std::min(peaks.up.power[up], peaks.down.power[down]);
  const double unit =
      measurement_bound(radar, 1.0, std::max(place.range_m, 1e-3), azimuth_rad).signal_to_noise;
  RadarMeasurement measured = with_sigmas(
      place, azimuth_rad,
      measurement_bound(radar, ratio / unit, std::max(place.range_m, 1e-3), azimuth_rad));
  state_spread(model, peaks, pair, measured);
  measured.azimuth_systematic_rad =
      0.5 * std::hypot(peaks.up.spread_rad[up], peaks.down.spread_rad[down]);
  return measured;
}

RadarMeasurement with_sigmas(const signal::RangeSpeed& place, double azimuth_rad,
                             const MeasurementBound& bound) {
  return {place.range_m,       place.radial_speed_mps,     azimuth_rad,
          bound.range_sigma_m, bound.range_rate_sigma_mps, bound.azimuth_sigma_rad};
}

std::vector<RadarMeasurement> simulated_frame(const core::HighwayScenario& scenario,
                                              const core::HighwayRadar& given,
                                              const SimulationSettings& settings,
                                              std::uint64_t seed, std::uint32_t run, int frame) {
  check(settings);
  core::HighwayRadar radar = given;
  radar.ramp_s = ramp_of(settings.scheme, given.waveforms);
  const Draws draws(seed, run, frame);
  const std::vector<Seen> targets = seen_targets(scenario, radar, settings, draws, frame);
  signal::TriangleParameters ramps;
  ramps.frequency_Hz = radar.centre_frequency_Hz;
  ramps.bandwidth_Hz = radar.bandwidth_Hz;
  ramps.ramp_s = radar.ramp_s;
  const signal::TriangleModel first = signal::triangle_model(signal::triangle(ramps), 0);
  const signal::PairingLimits limits{0.0, 1.1 * radar.most_range_m, settings.most_speed_mps};
  const bool by_direction =
      settings.scheme == Scheme::two_stage || settings.scheme == Scheme::coded;
  const Cell cell{settings.merge_bins, [&](double signal_to_noise) {
                    return by_direction ? one_direction(radar, settings.scheme, signal_to_noise)
                                        : std::numeric_limits<double>::infinity();
                  }};
  const RampPeaks peaks = peaks_of(first, 0.0, targets, cell, radar.ramp_s, draws, 1);
  std::vector<RadarMeasurement> result;
  if (by_direction) {
    result = coarse_to_fine(first, peaks, targets, radar, settings, draws);
  } else {
    std::vector<signal::RangeSpeed> places;
    if (settings.scheme == Scheme::triangle) {
      places = signal::pair_all(first, peaks.up.Hz, peaks.down.Hz, limits);
    } else if (settings.scheme == Scheme::sorted_triangle) {
      places = signal::pair_sorted(first, peaks.up.Hz, peaks.down.Hz, limits);
    } else {
      const signal::TriangleModel second = signal::triangle_model(
          signal::two_slopes({ramps, radar.waveforms.two_slopes_ramp_s[1]}), 1);
      const double between_s = second.turnaround_s - first.turnaround_s;
      const RampPeaks later = peaks_of(second, between_s, targets, cell, radar.ramp_s, draws, 2);
      places = signal::pair_two_slopes({first, peaks.up.Hz, peaks.down.Hz},
                                       {second, later.up.Hz, later.down.Hz}, {limits, 1.3});
    }
    for (const signal::RangeSpeed& place : places)
      result.push_back(measured_pair(first, peaks, place, radar));
  }
  add_false(radar, settings, draws, result);
  return result;
}

}  // namespace fanbeam::tracking
