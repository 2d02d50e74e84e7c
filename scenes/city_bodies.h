// Buildings of a CityJSON file on the scene's ground.
#pragma once

#include <string>

#include "scenes/description.h"
#include "scenes/ground.h"
#include "scenes/objects.h"

namespace fanbeam::scenes {

// One mesh, with an object for each building. Unless heights are to be as filed, the lowest point of each
// building stands on the lowest ground under it, so that a model of another terrain floats nowhere; its
// lowest corners then go kFoundation_m into the ground. Buildings beyond the terrain are left out with
// W-OUTSIDE, surface names of the scene that the file does not have are W-UNUSED. Throws as
// terrain::read_cityjson.
void add_city(const std::string& text, const BuildingsDescription& buildings, const Ground& ground,
              const MaterialNames& names, core::ProblemList& problems, Bodies& bodies);

}  // namespace fanbeam::scenes
