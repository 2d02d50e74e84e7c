#include "renderer/plan/frame_facts.h"

#include <algorithm>

namespace fanbeam::renderer {

SceneFacts frame_facts(const SceneFacts& sequence, const FrameSight& sight) {
  SceneFacts facts = sequence;
  facts.lowest_m = sight.lowest_m;
  facts.highest_m = sight.highest_m;
  facts.reflects = sequence.reflects && sight.mirrors;
  facts.has_walls = sequence.has_walls && sight.mirrored_rays_end;
  facts.ground_reflects = sequence.ground_reflects && sight.ground_mirrors;
  facts.has_point_targets = sequence.has_point_targets && sight.point_targets;
  if (!facts.has_point_targets) facts.rcs_sum_m2 = 0.0;
  facts.fluctuating_targets = sequence.fluctuating_targets && facts.has_point_targets;
  facts.weather.rain_cells = sight.rain_cells;
  facts.largest_eta_m2_per_m3 =
      std::min(sequence.largest_eta_m2_per_m3, sight.largest_eta_m2_per_m3);
  return facts;
}

}  // namespace fanbeam::renderer
