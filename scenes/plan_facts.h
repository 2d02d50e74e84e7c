// What the effect plan wants to know of a scene, wherever in its flight volume a frame is made.
#pragma once

#include <vector>

#include "renderer/plan/scene_facts.h"
#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/flight_volume.h"
#include "scenes/site.h"

namespace fanbeam::scenes {

// `weather` with its rain cells placed; `largest_eta_m2_per_m3` of what falls in it. `mirroring` by
// material id, as mirroring_materials() tells.
renderer::SceneFacts facts_of(const SceneDescription& description, const Site& site,
                              const FlightVolume& volume, const atmosphere::Weather& weather,
                              double largest_eta_m2_per_m3,
                              const std::vector<renderer::PointTarget>& targets,
                              const std::vector<bool>& mirroring);

}  // namespace fanbeam::scenes
