#include "sensors/display/seed_signal.h"

#include <cmath>

#include "core/errors.h"

namespace fanbeam::sensors {

SignalLimits seed_signal_limits(const Sensor& sensor) {
  const double nearest_m = sensor.range.minimum_m;
  if (!(nearest_m > 0.0))
    core::throw_input_error(core::ErrorClass::range, "range.minimum_m", nearest_m,
                            "above 0 for the display mapping \"seed\"");
  const SeedConvention& seed = sensor.seed;
  const double farthest_m = seed.active ? seed.maximum_range_m : sensor.range.maximum_m();
  const double depth_m = seed.active ? seed.speed_of_light_mps * seed.pulse_s /
                                           (2.0 * std::cos(seed.elevation_minimum_rad))
                                     : sensor.range.cell_m;
  SignalLimits limits;
  limits.constant_power_W_m3 = sensor.radar_constant_W_m2() * sensor.azimuth_patch_rad() * depth_m;
  limits.minimum_W = limits.constant_power_W_m3 / (farthest_m * farthest_m * farthest_m);
  limits.maximum_W = limits.constant_power_W_m3 / (nearest_m * nearest_m * nearest_m);
  return limits;
}

}  // namespace fanbeam::sensors
