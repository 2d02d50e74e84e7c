#include "renderer/casting/sampling.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

Sampling reference_sampling(std::uint64_t seed) {
  Sampling sampling;
  sampling.sub_columns = 16;
  sampling.jittered_passes = 16;
  sampling.rays_per_cell = 8.0;
  sampling.refinement_depth = 0;
  sampling.largest_step_rad = 1.0e-4;
  sampling.deposit_intervals = false;
  sampling.seed = seed;
  return sampling;
}

Sampling sampling_for(double rays_per_cell) {
  Sampling sampling;
  // At least one ray per cell and sub-column: below that, cells share rays and the error doubles.
  sampling.sub_columns = rays_per_cell < 2.0    ? 1
                         : rays_per_cell < 4.0  ? 2
                         : rays_per_cell < 12.0 ? 4
                                                : 8;
  sampling.rays_per_cell = rays_per_cell / sampling.sub_columns;
  return sampling;
}

}  // namespace fanbeam::renderer
