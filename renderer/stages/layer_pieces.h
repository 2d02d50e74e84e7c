// Visible pieces of a slice as layers sort them into cells. Private to the layers.
//
// Wide ones go in parts, so that the antenna's pattern is that of their middle. Neighbours on the ground
// that lie in one plane go together, as plains and runways have many to a range cell: planes that pass the
// sensor at distances within 0.2 % of each other count as one: 0.2 % of the grazing angle's sine, 0.01 dB
// of an NRCS that rises with it.
#pragma once

#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/slice_sweep.h"

namespace fanbeam::renderer {

// Elevation that one piece may span.
inline constexpr double kMostSpan_rad = 0.008;

// What spans more leaves `pieces` and goes to `parts`; `full` empties them whenever there is no room.
// Backs of facets go nowhere.
void fit_pieces(VisiblePieces& pieces, VisiblePieces& parts, const SliceSweep::Full& full);

}  // namespace fanbeam::renderer
