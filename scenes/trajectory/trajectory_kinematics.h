// Private to the flight paths: rates of sampled quantities and what an aircraft's bank follows
// from.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/geodetic.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

inline constexpr double kStandardGravity_mps2 = 9.80665;  // CGPM 1901, exact

// Slope of the secant between the samples `half_window_s` before and after each one, at least its
// neighbours; one-sided at the ends. Exact for a parabola away from the ends. A single sample has
// slope 0. Times increase and are as many as the values.
std::vector<glm::dvec3> slopes_per_s(const std::vector<double>& times_s,
                                     const std::vector<glm::dvec3>& values, double half_window_s);

// Velocity over ground, north-east-down at each position, as above. `frame` says which Earth.
std::vector<glm::dvec3> velocities_N_mps(const std::vector<double>& times_s,
                                         const std::vector<core::Geodetic>& positions,
                                         const terrain::LocalFrame& frame, double half_window_s);

// Bank of a turn without side force, tan(roll) = lateral acceleration / g, positive to the right;
// vertical acceleration is neglected. 0 without ground speed.
double coordinated_roll_rad(const glm::dvec3& v_N_mps, const glm::dvec3& a_N_mps2);

// The same place on the ellipsoid.
constexpr core::Geodetic foot_point(const core::Geodetic& position) {
  return {position.latitude_rad, position.longitude_rad, 0.0};
}

// From 0 at `x` <= 0 to 1 at `x` >= 1, with slope 0 at both ends.
double smooth_step(double x);

}  // namespace fanbeam::scenes
