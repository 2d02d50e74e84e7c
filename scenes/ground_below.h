// The ground under a place of the Earth.
#pragma once

#include <optional>

#include "core/geodetic.h"
#include "scenes/scene.h"

namespace fanbeam::scenes {

// On the ground below a place, or above it, along the vertical there: within 0.01 mm of the terrain's
// triangles. Nothing where the scene has no ground.
std::optional<core::Geodetic> ground_below(const Scene& scene, core::Geodetic at);

}  // namespace fanbeam::scenes
