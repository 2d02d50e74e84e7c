// Inside or outside of a closed outline in the plane.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace fanbeam::terrain {

// Whether the way from the point to the far east crosses the ring an odd number of times: then the
// point is inside, by the even-odd rule. Of several rings an odd number must say so (a courtyard is
// outside). The last point of a ring is joined to the first. Of the points on an edge, those on a
// southern or western one are inside, up to rounding: outlines side by side share no point.
inline bool crosses_odd(const std::vector<glm::dvec2>& ring_m, double x_m, double y_m) noexcept {
  bool odd = false;
  for (std::size_t i = 0, j = ring_m.size() - 1; i < ring_m.size(); j = i++) {
    const glm::dvec2& a = ring_m[i];
    const glm::dvec2& b = ring_m[j];
    if ((a.y > y_m) != (b.y > y_m) && x_m < (b.x - a.x) * (y_m - a.y) / (b.y - a.y) + a.x)
      odd = !odd;
  }
  return odd;
}

}  // namespace fanbeam::terrain
