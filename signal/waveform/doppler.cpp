#include "signal/waveform/doppler.h"

#include <cmath>

#include "core/constants.h"
#include "core/errors.h"

namespace fanbeam::signal {

double doppler_shift_Hz(double radial_speed_mps, double frequency_Hz) {
  const double closing_mps = 0.0 - radial_speed_mps;  // at rest 0, not -0
  if (!(std::abs(closing_mps) < core::kSpeedOfLight_mps))
    core::throw_input_error(core::ErrorClass::range, "radial_speed_mps", radial_speed_mps,
                            "below the speed of light");
  return 2.0 * closing_mps * frequency_Hz / (core::kSpeedOfLight_mps - closing_mps);
}

double fold(double value, double half) {
  // What is inside stays as it is, to the last bit.
  if (value >= -half && value < half) return value;
  return fold_positive(value + half, 2.0 * half) - half;
}

double fold_positive(double value, double length) {
  const double rest = value - length * std::floor(value / length);
  // Rounding may give the length itself for a value just below zero.
  return rest < length ? (rest < 0.0 ? 0.0 : rest) : 0.0;
}

}  // namespace fanbeam::signal
