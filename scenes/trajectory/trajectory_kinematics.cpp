#include "scenes/trajectory/trajectory_kinematics.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

namespace fanbeam::scenes {

std::vector<glm::dvec3> slopes_per_s(const std::vector<double>& times_s,
                                     const std::vector<glm::dvec3>& values, double half_window_s) {
  const std::size_t count = values.size();
  std::vector<glm::dvec3> slopes(count, glm::dvec3(0.0));
  if (count < 2) return slopes;
  std::size_t before = 0;
  std::size_t after = 0;
  for (std::size_t i = 0; i < count; ++i) {
    while (times_s[before] < times_s[i] - half_window_s) ++before;
    while (after + 1 < count && times_s[after + 1] <= times_s[i] + half_window_s) ++after;
    const std::size_t first = i > 0 ? std::min(before, i - 1) : 0;
    const std::size_t last = std::min(std::max(after, i + 1), count - 1);
    slopes[i] = (values[last] - values[first]) / (times_s[last] - times_s[first]);
  }
  return slopes;
}

std::vector<glm::dvec3> velocities_N_mps(const std::vector<double>& times_s,
                                         const std::vector<core::Geodetic>& positions,
                                         const terrain::LocalFrame& frame, double half_window_s) {
  std::vector<glm::dvec3> local_m;
  local_m.reserve(positions.size());
  for (const core::Geodetic& position : positions) local_m.push_back(frame.to_local_m(position));
  std::vector<glm::dvec3> velocities = slopes_per_s(times_s, local_m, half_window_s);
  for (std::size_t i = 0; i < positions.size(); ++i)
    velocities[i] = glm::transpose(frame.north_east_down_at(positions[i])) * velocities[i];
  return velocities;
}

double coordinated_roll_rad(const glm::dvec3& v_N_mps, const glm::dvec3& a_N_mps2) {
  const double speed_mps = std::hypot(v_N_mps.x, v_N_mps.y);
  if (speed_mps == 0.0) return 0.0;
  const double to_the_right_mps2 = (v_N_mps.x * a_N_mps2.y - v_N_mps.y * a_N_mps2.x) / speed_mps;
  return std::atan(to_the_right_mps2 / kStandardGravity_mps2);
}

double smooth_step(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}  // namespace fanbeam::scenes
