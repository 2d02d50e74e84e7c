// A batch of rays on their way through the kernel, side by side so that every step is one loop.
//
// Steps and what they fill: places (elevation, sub-column), aim (directions), cast (what was hit),
// shade (what comes back). 64 rays keep all of it in the first-level cache, and make whole packets
// of 8 and of 16.
#pragma once

#include <cstdint>

#include "renderer/casting/sub_column.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

inline constexpr int kBatchRays = 64;

// Lanes from `count` on repeat the last ray, so that no loop has a rest; they are not cast and hit
// nothing.
struct RayBatch {
  int count = 0;

  // Where rays are wanted.
  alignas(64) double elevation_rad[kBatchRays];
  alignas(64) double offset_rad[kBatchRays];  // from the middle of the sub-column
  alignas(64) double column_cosine[kBatchRays], column_sine[kBatchRays];
  alignas(64) double gain[kBatchRays];  // two-way, of the elevation beam

  // Where they go; `higher` is the change of direction with elevation.
  alignas(64) float direction_x[kBatchRays], direction_y[kBatchRays], direction_z[kBatchRays];
  alignas(64) float higher_x[kBatchRays], higher_y[kBatchRays], higher_z[kBatchRays];
  alignas(64) double jacobian[kBatchRays];  // ray_caster.h

  // What they meet. Without a hit only `geometry` means something.
  alignas(64) float distance_m[kBatchRays];
  alignas(64) float normal_x[kBatchRays], normal_y[kBatchRays], normal_z[kBatchRays];
  alignas(64) std::uint32_t geometry[kBatchRays], primitive[kBatchRays];

  void set_column(int lane, const SubColumn& column) {
    column_cosine[lane] = column.cosine;
    column_sine[lane] = column.sine;
  }
  void close(int filled) {
    count = filled;
    for (int i = filled; i < kBatchRays; ++i) {
      elevation_rad[i] = elevation_rad[filled - 1];
      offset_rad[i] = offset_rad[filled - 1];
      column_cosine[i] = column_cosine[filled - 1];
      column_sine[i] = column_sine[filled - 1];
      gain[i] = gain[filled - 1];
      geometry[i] = terrain::kNoHit;
    }
  }
};

}  // namespace fanbeam::renderer
