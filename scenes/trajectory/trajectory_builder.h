// From the [trajectory] description to a trajectory over the scene's ground.
#pragma once

#include <optional>

#include "scenes/description.h"
#include "scenes/ground.h"
#include "scenes/trajectory/trajectory.h"

namespace fanbeam::scenes {

// Nothing after reporting errors to `problems`, or for a runway end that is not there (scene_names.h).
std::optional<Trajectory> build_trajectory(const SceneDescription& scene, const Ground& ground,
                                           const terrain::LocalFrame& frame,
                                           core::ProblemList& problems);

}  // namespace fanbeam::scenes
