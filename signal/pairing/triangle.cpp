#include "signal/pairing/triangle.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/constants.h"
#include "core/errors.h"

namespace fanbeam::signal {
namespace {

constexpr double c_mps = core::kSpeedOfLight_mps;

TriangleModel model_of(const Segment& first, const Segment& second) {
  if (!(first.slope_Hz_per_s * second.slope_Hz_per_s < 0.0) ||
      first.duration_s != second.duration_s)
    core::throw_input_error(core::ErrorClass::unsupported, "stage", "no ramp up and ramp down",
                            "a triangle");
  const bool up_first = first.slope_Hz_per_s > 0.0;
  const Segment& up = up_first ? first : second;
  TriangleModel model;
  model.centre_frequency_Hz = up.middle_frequency_Hz();
  model.slope_Hz_per_s = up.slope_Hz_per_s;
  model.ramp_s = up.duration_s;
  model.turnaround_s = 0.5 * (first.middle_s() + second.middle_s());
  model.up_middle_s = up.middle_s() - model.turnaround_s;
  return model;
}

}  // namespace

TriangleModel triangle_model(const Waveform& waveform, int stage) {
  check(waveform);
  if (waveform.kind == WaveformKind::coded_triangle)
    return model_of(waveform.segments.front(), waveform.segments.back());
  const std::vector<Segment> segments = stage_segments(waveform, stage);
  if (segments.size() != 2)
    core::throw_input_error(core::ErrorClass::unsupported, "segments of the stage",
                            static_cast<double>(segments.size()), "2: a triangle");
  return model_of(segments[0], segments[1]);
}

RangeSpeed solve(const TriangleModel& model, const BeatPair& beats) {
  const double half_sum_Hz = 0.5 * (beats.up_Hz + beats.down_Hz);
  const double offset_Hz = model.slope_Hz_per_s * model.up_middle_s;
  // tau' is below 1e-3, so the second step is exact to rounding.
  double rate = half_sum_Hz / (model.centre_frequency_Hz + offset_Hz);
  for (int step = 0; step < 3; ++step)
    rate = half_sum_Hz / (model.centre_frequency_Hz + offset_Hz * (1.0 - rate));
  return {c_mps * (beats.up_Hz - beats.down_Hz) / (4.0 * model.slope_Hz_per_s * (1.0 - rate)),
          0.5 * c_mps * rate};
}

BeatPair predict(const TriangleModel& model, const RangeSpeed& target) {
  const double rate = 2.0 * target.radial_speed_mps / c_mps;
  const double delay_s = 2.0 * target.range_m / c_mps;
  const double moved_s = rate * model.up_middle_s;
  const double slope = model.slope_Hz_per_s * (1.0 - rate);
  const double doppler_Hz = model.centre_frequency_Hz * rate;
  return {slope * (delay_s + moved_s) + doppler_Hz, -slope * (delay_s - moved_s) + doppler_Hz};
}

bool PairingLimits::allow(const RangeSpeed& target) const {
  return target.range_m >= least_range_m && target.range_m <= most_range_m &&
         std::abs(target.radial_speed_mps) <= most_speed_mps;
}

std::vector<RangeSpeed> pair_sorted(const TriangleModel& model, std::vector<double> up_Hz,
                                    std::vector<double> down_Hz, const PairingLimits& limits) {
  std::sort(up_Hz.begin(), up_Hz.end());
  std::sort(down_Hz.begin(), down_Hz.end(), std::greater<>());
  std::vector<RangeSpeed> targets;
  for (std::size_t i = 0; i < std::min(up_Hz.size(), down_Hz.size()); ++i) {
    const RangeSpeed target = solve(model, {up_Hz[i], down_Hz[i]});
    if (limits.allow(target)) targets.push_back(target);
  }
  return targets;
}

std::vector<RangeSpeed> pair_all(const TriangleModel& model, const std::vector<double>& up_Hz,
                                 const std::vector<double>& down_Hz, const PairingLimits& limits) {
  std::vector<RangeSpeed> targets;
  for (const double up : up_Hz)
    for (const double down : down_Hz) {
      const RangeSpeed target = solve(model, {up, down});
      if (limits.allow(target)) targets.push_back(target);
    }
  return targets;
}

}  // namespace fanbeam::signal
