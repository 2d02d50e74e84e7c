#include "renderer/frame_pose.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/errors.h"

namespace fanbeam::renderer {
namespace {

// Rays along axes that are none end the process inside the ray caster.
void check_axes(const glm::dmat3& north_east_down) {
  constexpr const char* kField = "north, east and down";
  constexpr double kRounding = 1e-6;
  for (int i = 0; i < 9; ++i)
    if (const double part = north_east_down[i / 3][i % 3]; !std::isfinite(part))
      core::throw_input_error(core::ErrorClass::nonfinite, kField, part, "finite components");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (const double product = glm::dot(north_east_down[i], north_east_down[j]);
          !(std::abs(product - (i == j ? 1.0 : 0.0)) <= kRounding))
        core::throw_input_error(core::ErrorClass::range, kField, product,
                                "unit vectors at right angles");
}

}  // namespace

void check(const FramePose& pose) {
  // Beyond 1000 km from the scene's origin a float inside the ray caster no longer resolves a range
  // cell.
  constexpr double kFarthest_m = 1.0e6;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(pose.position_m[axis]))
      core::throw_input_error(core::ErrorClass::nonfinite, "sensor position", pose.position_m[axis],
                              "a finite coordinate");
    if (std::abs(pose.position_m[axis]) > kFarthest_m)
      core::throw_input_error(core::ErrorClass::range, "sensor position", pose.position_m[axis],
                              "within 1000 km of the scene's origin");
  }
  check_axes(pose.north_east_down);
  if (!std::isfinite(pose.time_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "pose time", pose.time_s,
                            "a finite number of seconds");
}

sensors::AntennaFrame antenna_of(const sensors::Sensor& sensor, const FramePose& pose) {
  return sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB, sensor.mounting,
                                sensor.scan.stabilised);
}

}  // namespace fanbeam::renderer
