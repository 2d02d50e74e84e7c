// What triple reflection uses of a trihedral's mouth, seen from one direction.
//
// With l <= m <= n the direction cosines to the three inner edges of length 1, the area is
//   triangular plates  4 l m / (l + m + n)  where l + m <= n, else (l + m + n) - 2 / (l + m + n)
//   square plates      4 l m / n            where n >= 2 m,   else l (4 - n / m)
// and 0 outside the octant between the plates. On the axis 1 / sqrt(3) and sqrt(3), hence the peaks
// 4 pi a^4 / (3 lambda^2) and 12 pi a^4 / lambda^2; half of that cross-section 19.5 deg off for the
// triangular, 10.3 deg (sideways) to 11.2 deg off for the square corner.
//
// Source: Robertson, Bell System Technical Journal 26 (1947), 852; Ruck, Radar Cross Section
// Handbook (1970), 8.3. The square form follows from where the straight ray of the unfolded corner
// crosses the three planes.
// Neglected: single and double bounces, edges. Accuracy: exact geometrical optics; tested against
// traced rays.
#pragma once

#include <glm/vec3.hpp>

namespace fanbeam::materials {

// For an inner edge of 1 m; the direction to the radar in target axes (rcs.h), of unit length.
double triangular_trihedral_area_m2(const glm::dvec3& direction);
double square_trihedral_area_m2(const glm::dvec3& direction);

}  // namespace fanbeam::materials
