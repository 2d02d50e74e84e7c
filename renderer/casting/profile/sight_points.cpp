#include "renderer/casting/profile/sight_points.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/casting/heading.h"

namespace fanbeam::renderer {

PointsOfSlices sort_points(const std::vector<Slice>& slices, const glm::dvec3& sensor_m,
                           const glm::dvec2& forward, const SightLines& sight) {
  std::vector<std::size_t> slice_of(sight.to_m.size());
  std::vector<double> headings_rad(sight.to_m.size());
  PointsOfSlices sorted;
  sorted.begin.assign(slices.size() + 1, 0);
  const double half_rad = slices.front().width_rad / 2;
  const auto before = [half_rad](const Slice& slice, double heading_rad) {
    return slice.heading_rad + half_rad < heading_rad;
  };
  for (std::size_t i = 0; i < sight.to_m.size(); ++i) {
    const double heading_rad = headings_rad[i] =
        turn_rad(forward, glm::dvec2(sight.to_m[i] - sensor_m));
    const auto at = std::lower_bound(slices.begin(), slices.end(), heading_rad, before);
    const bool inside = at != slices.end() && heading_rad >= at->heading_rad - half_rad;
    slice_of[i] = inside ? static_cast<std::size_t>(at - slices.begin()) : slices.size();
    if (inside) ++sorted.begin[slice_of[i] + 1];
  }
  for (std::size_t s = 0; s < slices.size(); ++s) sorted.begin[s + 1] += sorted.begin[s];
  sorted.points.resize(sorted.begin.back());
  std::vector<std::size_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (std::size_t i = 0; i < sight.to_m.size(); ++i) {
    if (slice_of[i] == slices.size()) continue;
    const glm::dvec3 there = sight.to_m[i] - sensor_m;
    sorted.points[next[slice_of[i]]++] = {headings_rad[i], glm::length(glm::dvec2(there)), there.z,
                                          i};
  }
  return sorted;
}

}  // namespace fanbeam::renderer
