// How much a run spends on each figure.
#pragma once

#include <cstdint>
#include <vector>

#include "measure/effort.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::benchmarks {

// With what the report has beyond a ladder.
struct Effort : measure::Effort {
  double converged_slices = 128.0;

  int operating_point = 0;  // repetitions
  // Things that are compared are measured in turns, so that all see the same machine.
  int turns = 0;
  int scaling_turns = 0;
  int sequence_frames = 0;
  int estimate_frames = 0;         // of each shipped scene
  int bound_frames = 0;            // the same
  std::vector<int> scaling_cells;  // of the ground along each side of the square
};

// Some twenty minutes on two cores.
Effort full_effort();

// A minute on two cores that exercises every part. Its figures mean nothing.
Effort quick_effort();

}  // namespace fanbeam::benchmarks
