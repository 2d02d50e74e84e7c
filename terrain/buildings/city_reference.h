// The positions of a city model, from its own reference system to WGS 84.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"

namespace fanbeam::terrain {

// The number in "https://www.opengis.net/def/crs/EPSG/0/7415", "urn:ogc:def:crs:EPSG::7415" and
// "EPSG:7415"; nothing for anything else: no definition that could name files gets to PROJ.
std::optional<int> epsg_code(const std::string& reference);

// In metres and radians. Nothing in place of what the system cannot convert. Throws InputError at
// `place`: E-REF for a code that PROJ does not know, E-UNSUPPORTED for coordinates from the Earth's centre.
std::vector<std::optional<core::Geodetic>> to_wgs84(const std::vector<glm::dvec3>& positions,
                                                    int epsg, const core::Place& place);

}  // namespace fanbeam::terrain
