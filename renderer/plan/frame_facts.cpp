#include "renderer/plan/frame_facts.h"

#include <algorithm>

namespace fanbeam::renderer {

SceneFacts seen_facts(const SceneFacts& scene, const FrameSight& sight) {
  SceneFacts facts = scene;
  facts.lowest_m = sight.lowest_m;
  facts.highest_m = sight.highest_m;
  facts.reflects = scene.reflects && sight.mirrors;
  facts.has_walls = scene.has_walls && sight.mirrored_rays_end;
  facts.ground_reflects = scene.ground_reflects && sight.ground_mirrors;
  facts.has_point_targets = scene.has_point_targets && sight.point_targets;
  if (!facts.has_point_targets) facts.rcs_sum_m2 = 0.0;
  facts.fluctuating_targets = scene.fluctuating_targets && facts.has_point_targets;
  facts.weather.rain_cells = sight.rain_cells;
  facts.largest_eta_m2_per_m3 = std::min(scene.largest_eta_m2_per_m3, sight.largest_eta_m2_per_m3);
  facts.leaves_ground = scene.leaves_ground && sight.leaves_ground;
  return facts;
}

}  // namespace fanbeam::renderer
