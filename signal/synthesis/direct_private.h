// Beat rows by the quadratic phase of each ramp, in double: any linear or flat segment.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/scatter_path.h"
#include "signal/synthesis/frame.h"

namespace fanbeam::signal {

// Adds the paths to every row of the cube. About 4 ns per sample and path for ramps of
// 400 samples, on one thread.
template <typename Real>
void add_direct(const Frame& frame, const std::vector<ScatterPath>& paths, Cube<Real>& cube);

extern template void add_direct(const Frame&, const std::vector<ScatterPath>&, FloatCube&);
extern template void add_direct(const Frame&, const std::vector<ScatterPath>&, DoubleCube&);

}  // namespace fanbeam::signal
