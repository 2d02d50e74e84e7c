// Where the aircraft is when a frame is made.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sensors/antenna/antenna_frame.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// The aircraft at one instant in scene axes.
struct FramePose {
  double time_s = 0.0;
  std::uint64_t frame_index = 0;  // keys what is random in the frame
  glm::dvec3 position_m{0.0};
  glm::dmat3 north_east_down{1.0};  // columns: unit vectors at the aircraft
  glm::dquat q_NB{1.0, 0.0, 0.0, 0.0};
};

// Throws InputError for what the ray caster cannot take, or takes the process down with: E-NONFINITE
// for a number, E-RANGE for a place beyond 1000 km of the scene's origin and for axes that are no
// unit vectors at right angles.
void check(const FramePose& pose);

// The sensor's antenna on the aircraft.
sensors::AntennaFrame antenna_of(const sensors::Sensor& sensor, const FramePose& pose);

}  // namespace fanbeam::renderer
