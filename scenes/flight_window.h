// Can every frame of the flight be rendered, and does what should move in it move?
#pragma once

#include "core/errors.h"
#include "scenes/description.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// In the middle of every frame the antenna, where its mounting puts it, must be over the terrain and
// above it, and there must be a frame. Adds E-RANGE to `problems`: for the first frame outside the
// terrain and the first in the ground, with the longest time between such frames; for a flight
// shorter than one frame. E-LIMIT for one of more than kMostFrames.
void check_flight(const SceneDescription& scene, const terrain::LocalFrame& frame,
                  const Trajectory& trajectory, const terrain::HeightField& ground,
                  core::ProblemList& problems);

// W-STANDS for each target that has a way, all of it over before the flight begins or begun after
// the flight ends: its times are often those of another clock. Nothing for a fixed pose, which holds
// at any time.
void tell_standing_targets(const SceneDescription& scene, const Trajectory& trajectory,
                           core::ProblemList& problems);

}  // namespace fanbeam::scenes
