// Private to the check of recorded flights: what is odd in a flight that is possible.
#pragma once

#include "core/errors.h"
#include "scenes/trajectory/track_motion.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// Warnings, and E-RANGE for an acceleration that nobody survives.
// Of the rows of `motion`, which are free of those that no aircraft could have flown. `track` says
// where they come from and which angles were recorded. Limits: scenes/trajectory/track_check.h.
void tell_oddities(const RawTrack& track, const TrackMotion& motion, core::ProblemList& problems);

// W-GAP for a track that is flown as recorded, without a smooth curve over its gaps.
void warn_of_gaps(const RawTrack& track, core::ProblemList& problems);

}  // namespace fanbeam::scenes
