// The weather of a scene: with its rain cells in local metres, and with all that it has.
#pragma once

#include "scenes/description.h"
#include "scenes/ground.h"

namespace fanbeam::scenes {

// Reports a cell whose place is unknown or outside the terrain to the ground's problems and leaves
// it out.
atmosphere::Weather placed_weather(const SceneDescription& scene, const Ground& ground);

// E-UNSUPPORTED for a loss that the weather switches off: a scene's plan decides which run.
void check_losses(const atmosphere::Weather& weather, core::ProblemList& problems);

}  // namespace fanbeam::scenes
