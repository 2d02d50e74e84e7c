// How many corners the polygons of one file may have. GEOS cuts a polygon that winds into triangles in a time
// with the cube of its corners: spirals of 1000, 2000 and 4000 took 0.27, 2.1 and 17 s.
#pragma once

#include <cstddef>
#include <string>

#include "core/errors.h"

namespace fanbeam::terrain {

inline constexpr std::size_t kMostCorners = 4000;  // of an outline and its holes
inline constexpr double kMostCubedCorners = 1e11;  // 100 polygons of 1000 corners

class CornerBudget {
 public:
  // Counts a polygon; false for one that is too much.
  bool take(std::size_t corners) {
    const auto count = static_cast<double>(corners);
    cubed_ += corners > kMostCorners ? 0.0 : count * count * count;
    return corners <= kMostCorners && cubed_ <= kMostCubedCorners;
  }
  static std::string expected() {
    return "at most " + std::to_string(kMostCorners) +
           " in one, and cubes of their counts of at most " + core::number_text(kMostCubedCorners) +
           " in the file";
  }

 private:
  double cubed_ = 0.0;
};

}  // namespace fanbeam::terrain
