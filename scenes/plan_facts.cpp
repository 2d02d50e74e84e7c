#include "scenes/plan_facts.h"

#include <algorithm>

#include "scenes/scene_mirrors.h"
#include "scenes/scene_surfaces.h"

namespace fanbeam::scenes {

renderer::SceneFacts facts_of(const SceneDescription& description, const Site& site,
                              const FlightVolume& volume, const atmosphere::Weather& weather,
                              double largest_eta_m2_per_m3,
                              const std::vector<renderer::PointTarget>& targets,
                              const std::vector<bool>& mirroring) {
  const SiteFacts& stands = site.parts().facts;
  renderer::SceneFacts facts;
  facts.weather = weather;
  facts.sensor = description.sensor;
  facts.sample = description.sample;
  facts.largest_eta_m2_per_m3 = largest_eta_m2_per_m3;
  facts.lowest_m = std::min(stands.lowest_m, volume.lowest_m);
  facts.highest_m = std::max(stands.highest_m, volume.highest_m);
  facts.vertical_turn_rad = volume.vertical_turn_rad;
  add_surface_facts(site, description.surface_state, facts);
  add_mirror_facts(stands, mirroring, facts);
  facts.has_point_targets = !targets.empty();
  for (const renderer::PointTarget& target : targets) {
    facts.fluctuating_targets =
        facts.fluctuating_targets || target.swerling != core::Swerling::steady;
    facts.rcs_sum_m2 += materials::largest_rcs_m2(target.rcs, facts.sensor.wavelength_m());
    // They may hang higher than anything else.
    for (const renderer::PointTarget::Waypoint& waypoint : target.path) {
      facts.lowest_m = std::min(facts.lowest_m, waypoint.position_m.z);
      facts.highest_m = std::max(facts.highest_m, waypoint.position_m.z);
    }
  }
  return facts;
}

}  // namespace fanbeam::scenes
