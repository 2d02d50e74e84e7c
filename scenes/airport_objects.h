// [[airport]]: the runways, taxiways and lights that a file of airports has, as what a scene would say of
// them itself.
#pragma once

#include "core/config_table.h"
#include "scenes/data_search.h"
#include "scenes/description.h"
#include "scenes/object_names.h"

namespace fanbeam::scenes {

// Adds to `scene`: runways (all on land, or those named), with width, surface, markings, shoulders, edge
// and approach lights as far as the file tells; pavements and rows of taxiway edge lights; the four units
// of each PAPI as targets. Elevations above mean sea level are brought to the scene's datum; where that is
// "scene", or an end has none, it lies on the scene's elevation data, or an end without one, where there are
// no such data, at the airport's own elevation. Errors of the file have its lines; E-REF for a runway that it
// does not have, and where nothing tells how high an end lies; E-RANGE for "scene" without elevation data.
// W-SKIPPED counts visual aids of other kinds.
void read_airport_table(core::ConfigTable& table, const DataSearch& search, ObjectNames& objects,
                        SceneDescription& scene);

}  // namespace fanbeam::scenes
