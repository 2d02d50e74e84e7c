// Heights and slopes of the ground in squares that double in size from level to level, and with them
// whether a ray that the ground mirrors may meet the ground again.
//
// A ray from the antenna O meets the ground at p, R = |Op| away, H below O and rho beside it in the
// level direction v, on a facet that rises by the gradient g. With the normal
// n = (-g, 1) / sqrt(1 + g^2) and d = (rho v, -H) / R the mirrored direction m = d - 2 (d.n) n has
//     m_z = (2 rho g.v + H (1 - g^2)) / ((1 + g^2) R) ,   sin psi = -d.n <= (rho |g| + H) / R ,
// and its level part turns from v by asin(2 |g| (|g| + H / rho)) at most. What it meets, q, has an
// echo within the farthest range r, (R + |pq| + |qO|) / 2 <= r, if
//     |pq| <= r (r - R) / (r - R sin^2 psi) ,
// which falls with R and grows with psi. Over a square with its gradients in a box, all mirrored
// rays therefore climb by a tangent t or more, inside a sector, so far. If t > 0 they meet nothing
//   in the square and the eight around it, when no gradient there rises by t in any direction of the
//     sector: the chord of the ground from p to q rises as the mean of what it passes, and stays in
//     the nine, which are convex together;
//   beyond them, when no square in sector and reach is as high as the lowest p and t times the
//     distance between the two squares.
// A square of which that is not certain is looked at by its quarters, down to 64 m or one cell; where
// it is not certain there, or after a hundred thousand looks, rays may meet something.
//
// The caster's facets are of floats: gradients are widened by what that turns them, heights by
// 50 mm (ray_scene.h: 25 mm). Cost: 10 ms a million cells to build; 20 us for a frame high above
// gentle ground, at most a millisecond.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/height_field.h"

namespace fanbeam::scenes {

// What the caster's floats may be off; a car's antenna is half a metre up.
inline constexpr double kRayError_m = 0.05;

class Relief {
 public:
  explicit Relief(const terrain::HeightField& ground);

  // `may_mirror` a box: rays of the antenna may meet ground in it that mirrors.
  bool may_mirror_into_itself(
      const glm::dvec3& antenna_m, double farthest_m,
      const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& may_mirror) const;

 private:
  struct Square {
    float low_m = 1e30F, high_m = -1e30F;
    glm::vec2 least{1e30F}, most{-1e30F};  // gradients, east and north

    void add(const Square& other);
  };
  struct Level {
    int columns = 0, rows = 0;
    double size_m = 0.0;
    std::vector<Square> squares;  // [row][column]

    const Square& at(int column, int row) const {
      return squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
  };
  class Search;

  void add_finest(const terrain::HeightField& ground);
  void add_coarser();

  glm::dvec2 corner_m_;        // south west
  std::vector<Level> levels_;  // the last of one square
};

}  // namespace fanbeam::scenes
