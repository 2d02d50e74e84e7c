// How much a run spends on each figure.
#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/stopwatch.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::benchmarks {

struct Effort {
  bool quick = false;
  // Ladders, coarsest first.
  std::vector<double> rays_per_cell;  // and column
  std::vector<double> slices;      // per column; numbers that the caster would round are left out
  std::vector<double> naive_rays;  // per frame
  double converged_slices = 128.0;
  int reference_passes = 16;  // times 16 sub-columns: azimuths per column

  Repetitions ladder, operating_point, naive;
  // Things that are compared are measured in turns, so that all see the same machine.
  int turns = 0;
  int scaling_turns = 0;
  int sequence_frames = 0;
  int estimate_frames = 0;         // of each shipped scene
  std::vector<int> scaling_cells;  // of the ground along each side of the square

  renderer::Sampling reference(std::uint64_t seed) const;
};

// Some twenty minutes on two cores.
Effort full_effort();

// A minute on two cores that exercises every part. Its figures mean nothing.
Effort quick_effort();

// Slices that a frame of this sampling really has in each column.
double slices_per_column(const renderer::Sampling& sampling);

}  // namespace fanbeam::benchmarks
