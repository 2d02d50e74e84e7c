#include "renderer/plan/frame_facts.h"

#include <algorithm>

#include "renderer/plan/largest_echo.h"

namespace fanbeam::renderer {

SceneFacts seen_facts(const SceneFacts& scene, const FrameSight& sight) {
  SceneFacts facts = scene;
  facts.lowest_m = sight.lowest_m;
  facts.highest_m = sight.highest_m;
  facts.reflects = scene.reflects && sight.mirrors;
  facts.mirrored_rays_end = scene.mirrored_rays_end && sight.mirrored_rays_end;
  facts.ground_reflects = scene.ground_reflects && sight.ground_mirrors;
  facts.has_point_targets = scene.has_point_targets && sight.point_targets;
  if (!facts.has_point_targets) facts.rcs_sum_m2 = 0.0;
  facts.fluctuating_targets = scene.fluctuating_targets && facts.has_point_targets;
  facts.weather.rain_cells = sight.rain_cells;
  facts.largest_eta_m2_per_m3 = std::min(scene.largest_eta_m2_per_m3, sight.largest_eta_m2_per_m3);
  facts.leaves_ground = scene.leaves_ground && sight.leaves_ground;
  return facts;
}

bool covers(const SceneFacts& planned, const SceneFacts& seen) {
  const auto within = [](bool part, bool whole) { return !part || whole; };
  const std::vector<atmosphere::RainCell>& cells = planned.weather.rain_cells;
  // Of mirrors the bounds ask what they make possible: nobody looks for those that do nothing.
  return within(corners_possible(seen), corners_possible(planned)) &&
         within(mirrored_targets_possible(seen), mirrored_targets_possible(planned)) &&
         within(seen.has_point_targets, planned.has_point_targets) &&
         within(seen.leaves_ground, planned.leaves_ground) &&
         seen.largest_eta_m2_per_m3 <= planned.largest_eta_m2_per_m3 &&
         std::all_of(seen.weather.rain_cells.begin(), seen.weather.rain_cells.end(),
                     [&](const atmosphere::RainCell& cell) {
                       return std::find(cells.begin(), cells.end(), cell) != cells.end();
                     });
}

}  // namespace fanbeam::renderer
