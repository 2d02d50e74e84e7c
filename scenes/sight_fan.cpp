#include "scenes/sight_fan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "sensors/antenna/column_place.h"

namespace fanbeam::scenes {

double fan_margin_rad(const sensors::Sensor& sensor) {
  // What the fan may be wider than field of view and beam: sub-columns come in whole groups.
  constexpr double kMarginColumns = 5.0;
  return sensor.antenna.azimuth.cut_rad + kMarginColumns * sensor.scan.column_width_rad();
}

SightFan::SightFan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor)
    : SightFan(antenna, half_of(sensor), sensor.scan.surface) {}

SightFan::SightFan(const sensors::AntennaFrame& antenna, double half_rad,
                   sensors::ScanSurface surface)
    : antenna_(antenna),
      cone_(surface == sensors::ScanSurface::cone),
      all_round_(half_rad >= core::kPi / 2),
      sine_(std::sin(std::min(half_rad, core::kPi / 2))),
      cosine_(std::cos(std::min(half_rad, core::kPi / 2))) {}

double SightFan::half_of(const sensors::Sensor& sensor) {
  return sensor.scan.field_of_view_rad / 2 + fan_margin_rad(sensor);
}

bool SightFan::may_meet(const glm::dvec3& centre_m, double radius_m) const {
  if (all_round_) return true;
  const glm::dvec3 to_m = centre_m - antenna_.position_m;
  const double right_m = std::abs(glm::dot(to_m, antenna_.right));
  if (cone_) return right_m <= (glm::length(to_m) + radius_m) * sine_ + radius_m;
  // Distance from the nearer side of the wedge.
  return right_m * cosine_ - glm::dot(to_m, antenna_.forward) * sine_ <= radius_m;
}

bool SightFan::may_meet_column(const glm::dvec2& centre_m, double radius_m, double far_m) const {
  if (all_round_) return true;
  const glm::dvec2 to_m = centre_m - glm::dvec2(antenna_.position_m);
  const double right_m = std::abs(glm::dot(to_m, glm::dvec2(antenna_.right)));
  const double right_up_m = far_m * std::abs(antenna_.right.z);
  if (cone_) return right_m - right_up_m - radius_m <= far_m * sine_;
  return right_m * cosine_ - glm::dot(to_m, glm::dvec2(antenna_.forward)) * sine_ <=
         radius_m + right_up_m * cosine_ + far_m * std::abs(antenna_.forward.z) * sine_;
}

double largest_turn_rad(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                        double slope_rad) {
  const double tilt_rad = std::acos(std::clamp(antenna.up.z, -1.0, 1.0));
  const double ray_rad = sensors::steepest_rad(sensor) + tilt_rad;
  const double grazing_rad = ray_rad + slope_rad;
  if (grazing_rad >= core::kPi / 2) return core::kPi;
  const double sine = 2.0 * std::sin(grazing_rad) * std::sin(slope_rad) / std::cos(ray_rad);
  return sine < 1.0 ? std::asin(sine) : core::kPi;
}

SightFan level_fan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                   double wider_rad) {
  sensors::AntennaFrame level;
  level.position_m = antenna.position_m;
  const glm::dvec2 heading(antenna.forward);
  const double steepest = sensors::steepest_rad(sensor);
  double half_rad = core::kPi;
  if (steepest < core::kPi / 2 && glm::length(heading) > 0.0) {
    level.forward = glm::dvec3(glm::normalize(heading), 0.0);
    level.right = {level.forward.y, -level.forward.x, 0.0};
    // |d - d0| of a direction and its turned one: 2 sin(turn / 2), the trace being 1 + 2 cos(turn).
    const double chord =
        std::sqrt(std::max(0.0, 3.0 - glm::dot(antenna.forward, level.forward) -
                                    glm::dot(antenna.right, level.right) - antenna.up.z));
    const double moved = chord / std::cos(steepest);
    half_rad = SightFan::half_of(sensor);
    if (sensor.scan.surface == sensors::ScanSurface::cone && half_rad < core::kPi / 2)
      half_rad = std::atan(std::tan(half_rad) / std::cos(steepest));
    half_rad += wider_rad + (moved < 1.0 ? std::asin(moved) : core::kPi);
  }
  return {level, half_rad, sensors::ScanSurface::plane};
}

}  // namespace fanbeam::scenes
