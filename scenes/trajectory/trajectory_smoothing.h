// Private to the flight paths: a smooth curve through noisy samples at uneven times.
#pragma once

#include <vector>

namespace fanbeam::scenes {

struct SmoothPoint {
  double value = 0.0;
  double rate_per_s = 0.0;
  double acceleration_per_s2 = 0.0;
};

// The fixed-interval smoother of Rauch, Tung and Striebel ("Maximum likelihood estimates of linear
// dynamic systems", AIAA Journal 3(8), 1965) for a value whose third derivative is white noise of
// spectral density `jerk_density` (value^2 / s^5), seen with independent errors of standard
// deviation `noise`. Equal to the quintic smoothing spline: features shorter than about
// (noise^2 step / jerk_density)^(1/6) seconds are taken as noise.
// Times increase and are as many as the values; both numbers are positive.
std::vector<SmoothPoint> smoothed(const std::vector<double>& times_s,
                                  const std::vector<double>& values, double noise,
                                  double jerk_density);

// The smoother's own curve between two neighbours `step_s` apart, at the part `s` in [0, 1] of the
// step: the quintic that meets value, rate and acceleration at both.
SmoothPoint between(const SmoothPoint& from, const SmoothPoint& to, double step_s, double s);

}  // namespace fanbeam::scenes
