// How high meshes reach over each square of a coarse grid: a bound that tells where to look for
// them, and where not.
#pragma once

#include <cstddef>
#include <vector>

#include "terrain/mesh.h"

namespace fanbeam::terrain {

class MeshTops {
 public:
  // Of the squares; twice as wide as often as it takes where meshes lie so far apart, or triangles are so
  // large, that there were more squares, or more of them under all triangles, than these.
  static constexpr double kSpacing_m = 32.0;
  static constexpr double kMostSquares = 1U << 24U, kMostCovered = 1U << 29U;
  // A triangle counts this far beside its bounding box too, so that who looks at points twice as far apart misses none.
  static constexpr double kBeside_m = kSpacing_m / 8;
  static constexpr double kNothing_m = static_cast<double>(-1e30F);

  MeshTops() = default;
  // Vertices that no triangle has do not count.
  explicit MeshTops(const std::vector<const TriangleMesh*>& meshes);

  double spacing_m() const noexcept { return spacing_m_; }

  // Upper bound of the height over the square that holds the point, rounded to a float;
  // kNothing_m where there is no mesh.
  double top_m(double x_m, double y_m) const noexcept {
    const double u = (x_m - west_m_) * per_spacing_;
    const double v = (y_m - south_m_) * per_spacing_;
    if (!(u >= 0.0 && v >= 0.0 && u < columns_ && v < rows_)) return kNothing_m;
    return static_cast<double>(
        top_m_[static_cast<std::size_t>(v) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(u)]);
  }

 private:
  // Squares from the first of the grid on, in which a length along an axis ends.
  int square_of(double along_m) const noexcept { return static_cast<int>(along_m * per_spacing_); }

  double spacing_m_ = kSpacing_m, per_spacing_ = 1.0 / kSpacing_m;  // powers of two: no rounding
  double west_m_ = 0.0, south_m_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> top_m_;
};

}  // namespace fanbeam::terrain
