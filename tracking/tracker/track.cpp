#include "tracking/tracker/track.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::tracking {

bool is_moving(const Track& track, const std::array<double, 2>& radar_velocity_mps,
               double least_mps) {
  const Gaussian state = combined(track.state);
  if (track.state.axes == 1) {
    const double speed = std::abs(state.mean[1] + radar_velocity_mps[0]);
    return speed - 2.0 * std::sqrt(std::max(state.variance(1, 1), 0.0)) > least_mps;
  }
  const double vx = state.mean[2] + radar_velocity_mps[0];
  const double vy = state.mean[3] + radar_velocity_mps[1];
  const double speed = std::hypot(vx, vy);
  if (!(speed > least_mps)) return false;
  const double variance = (vx * vx * state.variance(2, 2) + 2.0 * vx * vy * state.variance(2, 3) +
                           vy * vy * state.variance(3, 3)) /
                          (speed * speed);
  return speed - 2.0 * std::sqrt(std::max(variance, 0.0)) > least_mps;
}

}  // namespace fanbeam::tracking
