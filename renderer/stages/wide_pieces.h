// Visible pieces of a slice in parts, where they are seen under so wide an angle that the antenna's
// pattern is not that of their middle. Private to the layers.
#pragma once

#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/slice_sweep.h"

namespace fanbeam::renderer {

// Elevation that one piece may span.
inline constexpr double kMostSpan_rad = 0.008;

// What spans more leaves `pieces` and goes to `parts`; `full` empties them whenever there is no room.
// Backs of facets go nowhere.
void split_wide_pieces(VisiblePieces& pieces, VisiblePieces& parts, const SliceSweep::Full& full);

}  // namespace fanbeam::renderer
