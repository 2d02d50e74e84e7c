// The samplings worth trying for whoever has a time to keep.
#pragma once

#include <vector>

#include "renderer/casting/sampling.h"

namespace fanbeam::renderer {

// Slices per column, or rays per range cell and column, coarsest first.
std::vector<double> sampling_ladder(CasterKind caster);

}  // namespace fanbeam::renderer
