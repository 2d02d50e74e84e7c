// Random numbers and motion of simulated targets for the tests of filters.
#pragma once

#include "core/random.h"
#include "tracking/filters/motion.h"
#include "tracking/filters/observation.h"

namespace fanbeam::tests {

inline core::RandomKey run_key(int run, std::uint32_t stream = 1000) {
  return {20251121, stream, static_cast<std::uint32_t>(run)};
}

inline constexpr double kStep_s = 0.05;

inline tracking::MotionModel line(double acceleration_mps2 = 1.0) {
  tracking::MotionModel model;
  model.axes = 1;
  model.acceleration_mps2 = acceleration_mps2;
  return model;
}

inline tracking::Gaussian line_state(double position_sigma_m, double speed_sigma_mps) {
  tracking::Gaussian state;
  state.size = 2;
  state.variance(0, 0) = position_sigma_m * position_sigma_m;
  state.variance(1, 1) = speed_sigma_mps * speed_sigma_mps;
  return state;
}

inline tracking::RadarMeasurement seen(double range_m, double rate_mps, double range_sigma_m,
                                       double rate_sigma) {
  return {range_m, rate_mps, 0.0, range_sigma_m, rate_sigma, 0.0};
}

}  // namespace fanbeam::tests
