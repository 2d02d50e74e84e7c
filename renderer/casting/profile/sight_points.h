// The points of which is asked whether they are seen, by the slice that they lie in.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/slice_sweep.h"

namespace fanbeam::renderer {

struct PointsOfSlices {
  std::vector<std::size_t> begin;  // one more than slices
  std::vector<SightPoint> points;
};

// `forward` is the horizontal direction of heading 0. Points beyond the slices are in none.
PointsOfSlices sort_points(const std::vector<Slice>& slices, const glm::dvec3& sensor_m,
                           const glm::dvec2& forward, const SightLines& sight);

}  // namespace fanbeam::renderer
