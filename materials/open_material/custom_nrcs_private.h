// Reading side of custom_nrcs.h.
#pragma once

#include "core/json_node.h"
#include "materials/open_material/custom_nrcs.h"

namespace fanbeam::materials {

// Reports E-REF (missing and unknown keys), E-PARSE, E-RANGE, E-LIMIT with the JSON pointer; entries
// with a problem are left out.
std::vector<CustomNrcs> read_custom_nrcs(const core::JsonNode& custom_properties);

}  // namespace fanbeam::materials
