// Reading [weather] of a scene file.
#pragma once

#include "core/config_table.h"
#include "scenes/description.h"

namespace fanbeam::scenes {

// Numbers of [weather] keep the ranges that atmosphere documents; it checks them once more with the
// frequency.
void read_weather(core::ConfigTable& root, const SceneDescription& scene,
                  atmosphere::Weather& weather);

}  // namespace fanbeam::scenes
