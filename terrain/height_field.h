// The ground as a regular grid of posts in the local east-north plane, split into two triangles per
// cell.
//
// Posts carry the local "up" coordinate, so Earth curvature is already in them. Cells carry a
// material id that terrain does not interpret. Triangles: each cell is split from its south-west to
// its north-east post; height_at follows the same two planes that the ray caster sees.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace fanbeam::terrain {

using MaterialId = std::uint16_t;

struct HeightField {
  double west_m = 0.0;   // of the first post
  double south_m = 0.0;  // of the first post
  double spacing_m = 0.0;
  int columns = 0;                        // posts west to east, at least 2
  int rows = 0;                           // posts south to north, at least 2
  std::vector<double> height_m;           // [row][column]
  std::vector<MaterialId> cell_material;  // [row][column] of (rows - 1) x (columns - 1) cells

  std::size_t post(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns - 1) +
           static_cast<std::size_t>(column);
  }
  double east_m() const { return west_m + spacing_m * (columns - 1); }
  double north_m() const { return south_m + spacing_m * (rows - 1); }

  // Height of the triangulated surface; nothing outside the grid. Exact on the planes of the
  // triangles.
  std::optional<double> height_at(double x_m, double y_m) const;
};

// A grid of posts around the origin, all at height 0 and material 0: half extents and spacing in
// metres. Throws InputError E-RANGE or E-LIMIT (more than 64 million posts).
HeightField make_height_field(double west_m, double south_m, double east_m, double north_m,
                              double spacing_m);

}  // namespace fanbeam::terrain
