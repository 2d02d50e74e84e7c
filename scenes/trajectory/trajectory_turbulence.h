// Private to the ILS approach: how an aircraft and its autopilot answer gusts.
//
// A simple linear model, no particular aircraft: in each axis the airframe takes on the gust's
// velocity with a time constant of 1.5 s, and the autopilot pulls it back to the path with a
// natural frequency of 0.5 rad/s,
//   d'' = (gust - d') / 1.5 s - (0.5 / s)^2 d.
// Nose and wings follow the wind that the airframe has not yet taken on (gust - d') with a lag of
// 0.8 s: the nose turns into it by the angle it makes with the airspeed, and the bank leans away
// from a side gust by the same angle. All constants are assumed.
#pragma once

#include <glm/vec3.hpp>

#include "core/pose.h"

namespace fanbeam::scenes {

class GustResponse {
 public:
  struct Disturbance {
    glm::dvec3 offset_m{0.0};  // along the flight, right, down
    core::Attitude angles;     // to be added
  };

  // `gust_mps` along, right, down: the motion of the air.
  Disturbance next(const glm::dvec3& gust_mps, double airspeed_mps, double step_s);

 private:
  Disturbance now_;
  glm::dvec3 rate_mps_{0.0};
};

}  // namespace fanbeam::scenes
