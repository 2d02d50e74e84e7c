#include "signal/synthesis/beat_phase.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/constants.h"
#include "core/errors.h"

namespace fanbeam::signal {
namespace {

constexpr double kMostSpeed_mps = 1e5;
constexpr double kMostRange_m = 1e7;

std::string field_of(std::size_t index, const char* field) {
  return "path " + std::to_string(index) + " " + field;
}

void check_finite(std::size_t index, const char* field, double value) {
  if (!std::isfinite(value))
    core::throw_input_error(core::ErrorClass::nonfinite, field_of(index, field), value, "finite");
}

}  // namespace

PathGeometry::PathGeometry(const ScatterPath& path, const glm::dvec3& transmitter_m,
                           const glm::dvec3& receiver_m)
    : range_m_(path.range_m), speed_mps_(path.radial_speed_mps) {
  const glm::dvec3 towards = direction(path.azimuth_rad, path.elevation_rad);
  const glm::dvec3* elements_m[2] = {&transmitter_m, &receiver_m};
  for (int i = 0; i < 2; ++i) {
    along_m_[i] = glm::dot(towards, *elements_m[i]);
    square_m2_[i] = glm::dot(*elements_m[i], *elements_m[i]);
  }
}

PathLength PathGeometry::at(double time_s) const {
  const double range_m = range_m_ + speed_mps_ * time_s;
  PathLength path{2.0 * range_m, 0.0};
  for (int i = 0; i < 2; ++i) {
    // |x - p| = R + (p^2 - 2 R u.p) / (|x - p| + R): no difference of near equals.
    const double excess_m2 = square_m2_[i] - 2.0 * range_m * along_m_[i];
    const double distance_m = std::sqrt(range_m * range_m + excess_m2);
    path.length_m += excess_m2 / (distance_m + range_m);
    path.rate_mps += speed_mps_ * (range_m - along_m_[i]) / distance_m;
  }
  return path;
}

double beat_turns(const Waveform& waveform, const Segment& segment, double in_segment_s,
                  double delay_s) {
  if (waveform.kind == WaveformKind::sinusoidal) {
    const SinusoidalModulation& modulation = waveform.sinusoidal;
    const double swing = modulation.deviation_Hz / (2.0 * core::kPi * modulation.frequency_Hz);
    return segment.start_frequency_Hz * delay_s +
           swing *
               std::sin(2.0 * core::kPi * modulation.frequency_Hz *
                        (in_segment_s - 0.5 * delay_s)) *
               std::sin(core::kPi * modulation.frequency_Hz * delay_s);
  }
  return segment.start_frequency_Hz * delay_s +
         segment.slope_Hz_per_s * delay_s * (in_segment_s - 0.5 * delay_s);
}

void check(const Waveform& waveform, const std::vector<ScatterPath>& paths) {
  if (waveform.segments.empty()) return;
  const double first_s = waveform.segments.front().start_s;
  const double last_s = first_s + waveform.duration_s();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const ScatterPath& path = paths[i];
    check_finite(i, "azimuth_rad", path.azimuth_rad);
    check_finite(i, "elevation_rad", path.elevation_rad);
    check_finite(i, "amplitude_sqrtW", path.amplitude_sqrtW.real() + path.amplitude_sqrtW.imag());
    if (!(std::abs(path.radial_speed_mps) < kMostSpeed_mps))
      core::throw_input_error(core::ErrorClass::range, field_of(i, "radial_speed_mps"),
                              path.radial_speed_mps, "below 1e5 m/s in amount");
    for (const double time_s : {0.0, first_s, last_s}) {
      const double range_m = path.range_m + path.radial_speed_mps * time_s;
      if (!(range_m > 0.0 && range_m < kMostRange_m))
        core::throw_input_error(core::ErrorClass::range, field_of(i, "range_m"), range_m,
                                "above 0 and below 1e7 m during the whole waveform");
    }
  }
}

}  // namespace fanbeam::signal
