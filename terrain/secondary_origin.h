// Where a ray that leaves a surface must start so that it neither hits that surface again nor
// jumps over what stands close to it.
//
// The ray caster works in floats, u = 2^-24. A hit point computed from the caster's own origin,
// direction and distance lies off the facet by, along the facet's normal and to first order in u:
//   sqrt(3) u M   rounding of the facet's vertices, M the largest coordinate of the hit point
//   sqrt(3) u M   rounding of the new origin to floats
//   8 u d         the facet's normal (a cross product) and its distance seen from the old origin,
//                 d the distance of the hit, for triangles not thinner than 1 : 4
//   8 u s         the same seen from the new origin, s the size of the facet, at most 2 M
// The sum stays below 16 u (M + d): 1 mm for a hit 1 km from the sensor and the origin, 13 mm at
// 4 km from the sensor and 10 km from the origin. Source of the method: forward error analysis as
// in Pharr, Jakob and Humphreys, Physically Based Rendering, 3rd ed., section 3.9.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace fanbeam::terrain {

inline double secondary_offset_m(const glm::dvec3& hit_m, double distance_m) noexcept {
  constexpr double kRounding = 16.0 * 0x1p-24;
  const double largest_m = std::max({std::abs(hit_m.x), std::abs(hit_m.y), std::abs(hit_m.z)});
  return kRounding * (largest_m + distance_m);
}

// `normal` is of unit length and on the side that the new ray leaves to.
inline glm::dvec3 secondary_origin_m(const glm::dvec3& hit_m, const glm::dvec3& normal,
                                     double distance_m) noexcept {
  return hit_m + normal * secondary_offset_m(hit_m, distance_m);
}

}  // namespace fanbeam::terrain
