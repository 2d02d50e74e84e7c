// The antenna's axes in the scene, and angles in them.
//
// Scan surfaces, with f, r, u the components of a unit vector along forward, right and up:
//   plane  azimuth = atan2(r, f), elevation = asin(u): azimuth is the angle in the antenna's
//          horizontal plane
//   cone   azimuth = asin(r), elevation = atan2(u, f): a line array across the flight path sees
//          one phase step for all directions of one r, so lines of equal azimuth are cones around
//          the right axis
// Azimuth is positive right, elevation positive up. The two agree where elevation or azimuth is 0;
// at azimuth 20 deg and elevation -8.8 deg they differ by 0.25 deg in azimuth.
//
// Stabilised: the axes keep heading plus mounting yaw, forward lies in the local horizontal plane
// at the aircraft and up is its vertical. The antenna's place always turns with the aircraft.
// Neglected: lag and error of the stabilisation, bending of the airframe.
// Accuracy: angles and directions are each other's inverse within 1e-14 rad.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

// Right-handed as forward, right, down; unit vectors of the scene frame.
struct AntennaFrame {
  glm::dvec3 position_m{0.0};
  glm::dvec3 forward{1.0, 0.0, 0.0};
  glm::dvec3 right{0.0, -1.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
};

// `R_SN`: columns are north, east and down at the aircraft in scene axes. `q_NB` turns body axes
// (forward, right, down) into them, as in core::Pose.
// Throws InputError: E-NONFINITE for a quaternion or position that is not finite, E-RANGE for a
// quaternion of length 0.
AntennaFrame antenna_frame(const glm::dvec3& aircraft_position_m, const glm::dmat3& R_SN,
                           const glm::dquat& q_NB, const Mounting& mounting, bool stabilised);

struct AntennaAngles {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

// Unit vector in the scene frame. Any finite angles.
glm::dvec3 direction(const AntennaFrame& frame, double azimuth_rad, double elevation_rad,
                     ScanSurface surface);

// Angles of a vector from the antenna, of any length. Nothing for points that no picture can hold:
// in the antenna's lateral plane or behind it, at zero distance, or not finite.
std::optional<AntennaAngles> angles(const AntennaFrame& frame, const glm::dvec3& from_antenna_m,
                                    ScanSurface surface);

// The same for a scan that turns all round: plane surface, azimuth in [-pi, pi]; nothing only at
// zero distance or when not finite.
std::optional<AntennaAngles> all_round_angles(const AntennaFrame& frame,
                                              const glm::dvec3& from_antenna_m);

struct HeightSpan {
  double lowest_m = 0.0, highest_m = 0.0;
};
// Of the antenna and of all that its beam, side lobes included, may reach within the range gate, along
// the scene's vertical: the elevations of the beam, wider by the antenna's tilt against it.
HeightSpan heights_in_beam(const AntennaFrame& frame, const Sensor& sensor);

// Whether the beam of an outer column, side lobes included, reaches an azimuth of more than 90 deg at
// any of its elevations (column_place.h): also steeply below, where azimuths lie close together. A cone
// has no directions there.
bool beams_reach_behind(const Sensor& sensor);
// Of the two the one that the beams need: what they light has angles.
std::optional<AntennaAngles> angles(const AntennaFrame& frame, const glm::dvec3& from_antenna_m,
                                    const Sensor& sensor);

}  // namespace fanbeam::sensors
