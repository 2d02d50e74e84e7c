// Point targets that stand in each other: the same place, or way, to a millimetre, and the same
// cross-section from every side looked from. Two of them echo 3 dB more than the one that was
// meant, and nothing in the picture says so.
#pragma once

#include "core/errors.h"
#include "scenes/objects.h"

namespace fanbeam::scenes {

// W-DUPLICATE for each object whose points lie in those of an earlier one, with both names and
// places. Points of one object are its own affair.
void tell_duplicate_targets(const PointTargets& targets, double wavelength_m,
                            core::ProblemList& problems);

}  // namespace fanbeam::scenes
