// Extra loss in the rain cells of a scene: what changes along the ground.
//
// Two-way power factor 10^(-0.2 sum(gamma_i chord_i)): the chords of the straight path in each
// cell's prism (vertical_prism.h, exact) times the specific attenuation of the cell's rain by the
// weather's rain law. It multiplies the factor of PathAttenuation, so the loss in a cell adds to
// that of the rain around it; where cells overlap, their losses add.
// Neglected: gradients inside a cell, melting inside cells, cells' motion, elevation in the rain
// law.
// Accuracy: independent of how a path is cut to 1e-12. Cost: 10 ns per cell and path.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "atmosphere/precipitation/rain_cell.h"
#include "atmosphere/precipitation/vertical_prism.h"

namespace fanbeam::atmosphere {

struct Weather;

VerticalPrism prism_of(const RainCell& cell);

// Immutable: usable from any thread.
class RainCells {
 public:
  // Nothing is kept of cells without rain, and of any cell when rain is not simulated.
  // Throws InputError with every problem of problems_in(weather, frequency_Hz).
  RainCells(const Weather& weather, double frequency_Hz);

  // No cell takes anything from any path: callers need not ask.
  bool empty() const noexcept { return cells_.empty(); }

  // Whether any path of that plan can lose something.
  bool stand_between(const glm::dvec2& from_m, const glm::dvec2& to_m) const noexcept;

  // Along the straight path between two points in local metres (z above the origin); finite.
  double one_way_dB(const glm::dvec3& from_m, const glm::dvec3& to_m) const noexcept;

  // Power left after going there and back, 1 to 0; exactly 1 outside all cells.
  double two_way_power_factor(const glm::dvec3& from_m, const glm::dvec3& to_m) const noexcept;

  // Upper bound of one_way_dB for any path of this length, or of the sum over `legs` straight ones that
  // are as long together: each crosses a cell, which is convex, once.
  double largest_one_way_dB(double length_m, int legs = 1) const noexcept;

 private:
  struct Cell {
    VerticalPrism prism;
    double dB_per_km;
  };
  std::vector<Cell> cells_;
};

}  // namespace fanbeam::atmosphere
