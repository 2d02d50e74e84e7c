// The tables of scene.toml that put things on the ground: runways, surfaces, models, boxes,
// buildings, targets, lines.
#pragma once

#include "core/config_table.h"
#include "scenes/data_search.h"
#include "scenes/description.h"
#include "scenes/object_names.h"

namespace fanbeam::scenes {

void read_objects(core::ConfigTable& root, const DataSearch& search, ObjectNames& objects,
                  SceneDescription& scene);

// A place on the ground: { latitude_deg, longitude_deg } or { runway, behind_threshold_m, left_m }.
Spot read_spot(core::ConfigTable& table, std::string_view key);

}  // namespace fanbeam::scenes
