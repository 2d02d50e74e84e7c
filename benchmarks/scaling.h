// How frame time grows with the number of triangles: one ground at several spacings of its posts.
#pragma once

#include <cstddef>
#include <vector>

#include "benchmarks/bench_scene.h"
#include "benchmarks/report_effort.h"

namespace fanbeam::benchmarks {

struct ScalingStep {
  double spacing_m = 0.0;
  std::size_t triangles = 0;
  double rays_ms = 0.0;    // at default sampling
  double slices_ms = 0.0;  // the same
};

// The ground of the view's scene, its heights interpolated, with land cover, paint, sensor and
// weather but without buildings and targets, seen from the view's pose. All worlds are held at once
// and measured in turns. Coarsest ground first.
std::vector<ScalingStep> measure_scaling(const View& view, const Effort& effort);

}  // namespace fanbeam::benchmarks
