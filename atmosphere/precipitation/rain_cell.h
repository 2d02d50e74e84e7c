// A shower or a rain band: a vertical prism of uniform rain.
#pragma once

#include <glm/vec2.hpp>

namespace fanbeam::atmosphere {

// Local metres: x east, y north, heights above the scene's origin. A circle when `radius_m` is
// above 0, else a rectangle whose length lies along the heading (clockwise from north).
struct RainCell {
  glm::dvec2 centre_m{0.0};
  double radius_m = 0.0;                    // 0 to 100000
  double length_m = 0.0, width_m = 0.0;     // 0 to 200000
  double heading_rad = 0.0;                 // -2 pi to 2 pi
  double rain_rate_mm_per_h = 0.0;          // 0 to 300
  double base_m = -2000.0, top_m = 3000.0;  // -2000 to 12000, base below top

  bool operator==(const RainCell&) const = default;
};

}  // namespace fanbeam::atmosphere
