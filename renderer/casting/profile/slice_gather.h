// The slices of a frame to the sums of its fan, in parallel and in a fixed order of adding.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/profile/slice_layout.h"
#include "renderer/casting/profile/slice_tracer.h"

namespace fanbeam::renderer {

// Level slices: each lies in one sub-column. Writes the sums of `columns`, whatever they held, and
// adds to the counts.
void gather_level(const SliceFrame& frame, const std::vector<SubColumnSlices>& columns,
                  FanSums& sums);

// Slices that share sub-columns with their neighbours, as a tilted antenna or a cone scan sees
// them. Writes the sums of the whole fan and adds to the counts.
void gather_across(const SliceFrame& frame, FanSums& sums);

}  // namespace fanbeam::renderer
