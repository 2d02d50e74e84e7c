// Directions of a sensor's fan, rounded towards more.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sensors/antenna/antenna_frame.h"
#include "sensors/sensor.h"

namespace fanbeam::scenes {

// How far beside the field of view the fan may reach: its beam's cut, and what whole groups of
// sub-columns are more.
double fan_margin_rad(const sensors::Sensor& sensor);

// False only for what the directions certainly miss.
class SightFan {
 public:
  SightFan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor);
  SightFan(const sensors::AntennaFrame& antenna, double half_rad, sensors::ScanSurface surface);

  static double half_of(const sensors::Sensor& sensor);

  bool may_meet(const glm::dvec3& centre_m, double radius_m) const;
  // The same of all that a vertical column holds within `far_m`.
  bool may_meet_column(const glm::dvec2& centre_m, double radius_m, double far_m) const;

 private:
  sensors::AntennaFrame antenna_;
  bool cone_, all_round_;
  double sine_, cosine_;
};

// How far ground whose facets rise at most `slope` turns a ray of the beam to the side: the mirrored
// direction is d + 2 sin(psi) n, the level part of d at least cos(steepest ray), that of n at most
// sin(slope). Pi where it may turn it anywhere.
double largest_turn_rad(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                        double slope_rad);

// The fan's azimuths in the scene's horizontal, which is what level ground keeps of a ray that it
// mirrors: those of the antenna turned level under its heading, wider by what the turn back moves
// the steepest ray aside, and by `wider_rad`. The azimuth a of a ray on a cone is atan(tan a / cos e)
// there.
SightFan level_fan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                   double wider_rad);

}  // namespace fanbeam::scenes
