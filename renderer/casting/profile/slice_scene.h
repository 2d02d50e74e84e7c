// What the slices of all frames of a scene share: walls and paint seen from above, tables of powers,
// losses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/frame_path_loss.h"
#include "renderer/casting/heading.h"
#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/power_tables.h"
#include "renderer/casting/profile/sight_points.h"
#include "renderer/casting/profile/slice_tracer.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

class SliceScene {
 public:
  // `world` must outlive it and have a ground.
  explicit SliceScene(const World& world);

  // Calls `use` with a SliceFrame: what those of one frame share. `column`: slices that stand for about
  // a column. Answers of `sight` are left to rays until slices give them.
  template <class Use>
  void in_frame(const sensors::AntennaFrame& antenna, const std::vector<Slice>& slices, int column,
                SightLines& sight, const Use& use) const {
    // Fewer candidates, or fewer lists that an edge is in.
    const auto tile = static_cast<std::size_t>(std::min(column, 16));
    const glm::dvec2 forward = horizontal(antenna.forward);
    const EdgeIndex edges(rings_, world_.sensor.range.maximum_m(), antenna.position_m, forward,
                          slices, tile);
    sight.clear.assign(sight.to_m.size(), kAskRays);
    const PointsOfSlices points = sort_points(slices, antenna.position_m, forward, sight);
    const PathLossTable path_loss = path_loss_.from(antenna.position_m.z);
    use(SliceFrame{world_, antenna, tables_, path_loss, slices, edges, points, sight.clear.data(),
                   tile, dark_below(antenna)});
  }

 private:
  double dark_below(const sensors::AntennaFrame& antenna) const;

  const World& world_;
  std::vector<PlanRing> rings_;
  PowerTables tables_;
  FramePathLoss path_loss_;
};

}  // namespace fanbeam::renderer
