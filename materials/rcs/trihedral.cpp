#include "materials/rcs/trihedral.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fanbeam::materials {
namespace {

// Direction cosines to the three edges, smallest first.
std::array<double, 3> edge_cosines(const glm::dvec3& direction) {
  const double along = direction.x / std::sqrt(3.0);
  std::array<double, 3> cosines = {
      along + direction.z * std::sqrt(2.0 / 3.0),
      along + direction.y / std::sqrt(2.0) - direction.z / std::sqrt(6.0),
      along - direction.y / std::sqrt(2.0) - direction.z / std::sqrt(6.0)};
  std::sort(cosines.begin(), cosines.end());
  return cosines;
}

}  // namespace

double triangular_trihedral_area_m2(const glm::dvec3& direction) {
  const auto [l, m, n] = edge_cosines(direction);
  if (l <= 0.0) return 0.0;
  const double sum = l + m + n;
  return l + m <= n ? 4.0 * l * m / sum : sum - 2.0 / sum;
}

double square_trihedral_area_m2(const glm::dvec3& direction) {
  const auto [l, m, n] = edge_cosines(direction);
  if (l <= 0.0) return 0.0;
  return n >= 2.0 * m ? 4.0 * l * m / n : l * (4.0 - n / m);
}

}  // namespace fanbeam::materials
