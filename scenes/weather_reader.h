// Reading [weather] of a scene file.
#pragma once

#include "core/config_table.h"
#include "scenes/description.h"

namespace fanbeam::scenes {

// Fills `scene.weather` and `scene.rain_cells`. Numbers of [weather] keep the ranges that
// atmosphere documents; it checks them once more with the sensor's frequency.
void read_weather(core::ConfigTable& root, SceneDescription& scene);

}  // namespace fanbeam::scenes
