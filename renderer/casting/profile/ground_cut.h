// The ground under one azimuth: where a vertical half-plane cuts the triangles of a height field.
//
// Each piece is the straight cut through one triangle, so the profile is exact on the surface that
// the ray caster sees. Crossings with the grid's columns, rows and diagonals are found one after
// the other; heights at them are interpolated along the edge that is crossed, which both
// neighbours share.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/height_field.h"

namespace fanbeam::renderer {

struct GroundCut {
  struct Cell {
    std::int32_t column, row;
    bool upper;  // the triangle north-west of the cell's diagonal
  };
  // Piece i < pieces lies between points i and i + 1. The arrays only ever grow.
  std::size_t pieces = 0;
  std::vector<double> distance_m;  // horizontal, from the cut's origin, rising
  std::vector<double> height_m;    // relative to the height given
  std::vector<Cell> cells;
};

// Replaces `cut`. `along` is a unit vector; the cut goes from `origin_m` to `far_m` or the grid's
// edge and is empty where it misses the grid. Heights are given relative to `zero_m`.
void cut_ground(const terrain::HeightField& ground, const glm::dvec2& origin_m,
                const glm::dvec2& along, double far_m, double zero_m, GroundCut& cut);

}  // namespace fanbeam::renderer
