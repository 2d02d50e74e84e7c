// How many corners the polygons of one file may have. GEOS cuts a polygon into triangles in a time with the
// cube of its corners where it winds: a spiral of 4000 takes 17 s, one of 10 000 minutes.
#pragma once

#include <cstddef>
#include <string>

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
    return "at most 4000 in one, and cubes of their counts of at most 1e11 in the file";
  }

 private:
  double cubed_ = 0.0;
};

}  // namespace fanbeam::terrain
