// The second half of keystone_synthesis.h: from (rate, sine, sample) to (chirp, channel, sample).
#pragma once

#include "signal/cube.h"
#include "signal/synthesis/keystone_private.h"

namespace fanbeam::signal {

// Fills these channels of the cube. Rows of the grid hold samples: real parts from 0, imaginary
// parts from delays() on.
void transform_rates_and_sines(const Frame& frame, const std::vector<int>& channels,
                               const KeystoneAxes& axes, const SpreadingKernel& kernel,
                               const WaveGrid& grid, FloatCube& cube);

}  // namespace fanbeam::signal
