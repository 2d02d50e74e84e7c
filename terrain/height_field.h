// The ground as a regular grid of posts in the local east-north plane, split into two triangles per
// cell.
//
// Posts carry the local "up" coordinate, so Earth curvature is already in them. Cells carry a
// material id that terrain does not interpret. Triangles: each cell is split from its south-west to
// its north-east post; height_at follows the same two planes that the ray caster sees.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fanbeam::terrain {

using MaterialId = std::uint16_t;
// What a surface belongs to, for ground truth; whoever builds a scene names them.
using ObjectId = std::uint32_t;
inline constexpr ObjectId kTerrainObject = 0;

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
  std::optional<double> height_at(double x_m, double y_m) const {
    const double u = (x_m - west_m) / spacing_m;
    const double v = (y_m - south_m) / spacing_m;
    if (!(u >= 0.0 && v >= 0.0 && u <= columns - 1 && v <= rows - 1)) return std::nullopt;
    return on_triangles(u, v);
  }

  // The same, and outside the grid the height of the nearest place on its border. Of a place that is
  // no number that of a corner: a place in memory in any case.
  double nearest_height(double x_m, double y_m) const {
    return on_triangles(std::max(0.0, std::min((x_m - west_m) / spacing_m, columns - 1.0)),
                        std::max(0.0, std::min((y_m - south_m) / spacing_m, rows - 1.0)));
  }

 private:
  // Spacings east and north of the first post.
  double on_triangles(double u, double v) const {
    const int i = std::min(static_cast<int>(u), columns - 2);
    const int j = std::min(static_cast<int>(v), rows - 2);
    const double fu = u - i;
    const double fv = v - j;
    const double sw = height_m[post(i, j)];
    const double ne = height_m[post(i + 1, j + 1)];
    // The corner that the point's triangle has besides the diagonal: chosen, as a branch here would
    // be guessed wrong half of the time.
    const double third = height_m[fu >= fv ? post(i + 1, j) : post(i, j + 1)];
    return sw + std::max(fu, fv) * (third - sw) + std::min(fu, fv) * (ne - third);
  }
};

// A grid of posts around the origin, all at height 0 and material 0: half extents and spacing in
// metres. Throws InputError E-RANGE or E-LIMIT (more than 64 million posts).
HeightField make_height_field(double west_m, double south_m, double east_m, double north_m,
                              double spacing_m);

}  // namespace fanbeam::terrain
