// What a CIGI host asks of the scene: heights, and what a line of sight meets.
//
// Heights are along the vertical of the place itself, of the ground alone, not of what stands on it:
// the scene's triangulated terrain (with the runways that are flattened into it), to a millimetre. A
// line of sight meets buildings and models too; a hit is that of a ray in single precision near the
// scene's origin, to some centimetres at 5 km. Material codes are those of the layers
// (docs/products.md), materials by their index in Geometry::material_names; normals as azimuth
// clockwise from true north and elevation. Altitudes count from `datum`.
#pragma once

#include <optional>

#include "core/geodetic.h"
#include "core/pose.h"
#include "feeds/cigi/host_packets.h"
#include "feeds/cigi/ig_packets.h"
#include "scenes/scene.h"

namespace fanbeam::live {

// `entity`, `end_entity`: those of the request, for offsets; without it such a request is answered as not
// valid. So is one outside the terrain, and one whose answer is to be an offset.
feeds::cigi::HeightResponse height_answer(const scenes::Scene& scene, core::VerticalDatum datum,
                                          const feeds::cigi::HeightRequest& request,
                                          const std::optional<core::Pose>& entity);
feeds::cigi::SightResponse sight_answer(const scenes::Scene& scene, core::VerticalDatum datum,
                                        const feeds::cigi::SightRequest& request,
                                        const std::optional<core::Pose>& entity,
                                        const std::optional<core::Pose>& end_entity);

}  // namespace fanbeam::live
