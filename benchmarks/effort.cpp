#include "benchmarks/effort.h"

#include <algorithm>

namespace fanbeam::benchmarks {
namespace {

std::vector<double> cast_as_asked(std::vector<double> slices) {
  std::erase_if(slices, [](double count) {
    return slices_per_column(renderer::profile_sampling_for(count)) != count;
  });
  return slices;
}

}  // namespace

renderer::Sampling Effort::reference(std::uint64_t seed) const {
  return renderer::reference_sampling(seed, reference_passes);
}

Effort full_effort() {
  Effort effort;
  effort.rays_per_cell = {0.5, 1, 2, 4, 8, 16, 32, 64};
  effort.slices = cast_as_asked({1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64});
  effort.naive_rays = {0.1e6, 0.2e6, 0.5e6, 1e6, 2e6, 5e6, 10e6, 20e6};
  effort.ladder = {3, 21, 400.0};
  effort.operating_point = {11, 21, 600.0};
  effort.naive = {1, 5, 200.0};
  effort.turns = 11;
  effort.scaling_turns = 5;
  effort.sequence_frames = 48;
  effort.estimate_frames = 3;
  effort.scaling_cells = {224, 707, 1225, 2236};  // 0.1, 1, 3 and 10 million triangles
  return effort;
}

Effort quick_effort() {
  Effort effort = full_effort();
  effort.quick = true;
  effort.rays_per_cell = {0.5, 2, 8};
  effort.slices = {1, 4, 16};
  effort.naive_rays = {0.2e6, 1e6, 5e6};
  effort.converged_slices = 32.0;
  effort.reference_passes = 1;
  effort.ladder = effort.operating_point = {2, 2, 0.0};
  effort.naive = {1, 1, 0.0};
  effort.turns = effort.scaling_turns = 2;
  effort.sequence_frames = 4;
  effort.estimate_frames = 1;
  effort.scaling_cells = {100, 224};
  return effort;
}

double slices_per_column(const renderer::Sampling& sampling) {
  return static_cast<double>(sampling.sub_columns) * sampling.slices_per_sub_column;
}

}  // namespace fanbeam::benchmarks
