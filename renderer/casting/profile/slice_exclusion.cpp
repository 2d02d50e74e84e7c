#include "renderer/casting/profile/slice_exclusion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "renderer/casting/heading.h"

namespace fanbeam::renderer {
namespace {

// What a box covers of the horizon, seen from above; the whole of it from inside.
struct HeadingSpan {
  double left_rad = -core::kPi, right_rad = core::kPi;
  double nearest_m = 0.0;
};

HeadingSpan headings_of(const terrain::Box_m& box, const glm::dvec2& sensor_m,
                        const glm::dvec2& forward) {
  const glm::dvec2 low = glm::dvec2(box.low) - sensor_m, high = glm::dvec2(box.high) - sensor_m;
  const glm::dvec2 nearest = glm::clamp(glm::dvec2(0.0), low, high);
  HeadingSpan span;
  span.nearest_m = glm::length(nearest);
  if (span.nearest_m == 0.0) return span;
  const double middle_rad = turn_rad(forward, (low + high) / 2.0);
  double left_rad = 0.0, right_rad = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
    const double beside_rad = std::remainder(turn_rad(forward, at) - middle_rad, 2.0 * core::kPi);
    left_rad = std::min(left_rad, beside_rad);
    right_rad = std::max(right_rad, beside_rad);
  }
  span.left_rad = middle_rad + left_rad;
  span.right_rad = middle_rad + right_rad;
  return span;
}

}  // namespace

std::vector<std::uint8_t> sub_columns_for_rays(const World& world,
                                               const sensors::AntennaFrame& antenna,
                                               const std::vector<Slice>& slices,
                                               int slices_per_sub_column, const FanSums& sums) {
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(sums.sub_columns), 0);
  const glm::dvec2 sensor_m(antenna.position_m.x, antenna.position_m.y);
  const glm::dvec2 forward = horizontal(antenna.forward);
  const auto per_sub = static_cast<std::size_t>(slices_per_sub_column);
  const double beside_rad = slices.front().width_rad / 2 + kLeaning_rad;
  const auto slice_at = [&](double heading_rad) {
    const auto before = [](const Slice& slice, double rad) { return slice.heading_rad < rad; };
    return static_cast<std::size_t>(
        std::lower_bound(slices.begin(), slices.end(), heading_rad, before) - slices.begin());
  };
  for (const terrain::Box_m& box : world.solids().others) {
    const HeadingSpan span = headings_of(box, sensor_m, forward);
    if (span.nearest_m > world.sensor.range.maximum_m()) continue;
    const std::size_t first = slice_at(span.left_rad - beside_rad);
    const std::size_t last = slice_at(span.right_rad + beside_rad);
    for (std::size_t i = first; i < last; ++i) wanted[i / per_sub] = 1;
  }
  return wanted;
}

}  // namespace fanbeam::renderer
