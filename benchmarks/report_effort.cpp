#include "benchmarks/report_effort.h"

#include <algorithm>

namespace fanbeam::benchmarks {
namespace {

std::vector<double> cast_as_asked(std::vector<double> slices) {
  std::erase_if(slices, [](double count) {
    return samples_in(renderer::profile_sampling_for(count)) != count;
  });
  return slices;
}

}  // namespace

Effort full_effort() {
  Effort effort;
  effort.rays = {0.5, 1, 2, 4, 8, 16, 32, 64};
  effort.slices = cast_as_asked({0.3, 0.5, 1, 1.4, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64});
  effort.plain_rays = {1, 2, 6, 12, 24, 60};  // more do not help it
  effort.dithered_rays = {1, 2, 6, 12, 24, 60, 120, 240};
  effort.repetitions = 5;
  effort.operating_point = 15;
  effort.turns = 11;
  effort.scaling_turns = 5;
  effort.sequence_frames = 48;
  effort.estimate_frames = 3;
  effort.bound_frames = 8;
  effort.scaling_cells = {224, 707, 1225, 2236};  // 0.1, 1, 3 and 10 million triangles
  return effort;
}

Effort quick_effort() {
  Effort effort = full_effort();
  effort.quick = true;
  effort.rays = {0.5, 2, 8};
  effort.slices = {1, 4, 16};
  effort.plain_rays = effort.dithered_rays = {2, 12, 60};
  effort.converged_slices = 32.0;
  effort.reference_passes = 1;
  effort.repetitions = effort.operating_point = 2;
  effort.turns = effort.scaling_turns = 2;
  effort.sequence_frames = 4;
  effort.estimate_frames = effort.bound_frames = 1;
  effort.scaling_cells = {100, 224};
  return effort;
}

}  // namespace fanbeam::benchmarks
