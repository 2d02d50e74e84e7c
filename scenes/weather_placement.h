// The weather of a scene with its rain cells in local metres.
#pragma once

#include "scenes/description.h"
#include "scenes/ground.h"

namespace fanbeam::scenes {

// Reports a cell whose place is unknown or outside the terrain to the ground's problems and leaves
// it out.
atmosphere::Weather placed_weather(const SceneDescription& scene, const Ground& ground);

}  // namespace fanbeam::scenes
