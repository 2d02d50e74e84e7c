// Where the aircraft is and how it is turned at one instant.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "core/geodetic.h"

namespace fanbeam::core {

// Body axes X forward, Y right, Z down. `q_NB` turns body vectors into the north-east-down frame at
// `position` (yaw, pitch, roll applied in this order about Z, Y', X''; heading is true).
struct Pose {
  double time_s = 0.0;
  Geodetic position;
  glm::dquat q_NB{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 v_N_mps{0.0, 0.0, 0.0};  // velocity over ground, north-east-down
};

// Aircraft angles: roll positive right wing down, pitch positive nose up, heading clockwise from
// true north.
struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double heading_rad = 0.0;
};

glm::dquat quaternion_from(const Attitude& attitude);

// heading in [0, 2 pi), pitch in [-pi/2, pi/2]. At pitch +-90 deg roll is returned as 0 and heading
// carries the turn.
Attitude attitude_from(const glm::dquat& q_NB);

// Spherical interpolation on the short arc, s in [0, 1]; q and -q are the same attitude.
// Throws InputError E-RANGE when a quaternion has (nearly) zero length, E-NONFINITE when one is not
// finite.
glm::dquat interpolate(const glm::dquat& from, const glm::dquat& to, double s);

}  // namespace fanbeam::core
