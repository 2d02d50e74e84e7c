// The [trajectory] table of scene.toml.
#pragma once

#include "core/config_table.h"
#include "scenes/data_search.h"
#include "scenes/description.h"

namespace fanbeam::scenes {

void read_trajectory(core::ConfigTable& root, const DataSearch& search, SceneDescription& scene);

}  // namespace fanbeam::scenes
