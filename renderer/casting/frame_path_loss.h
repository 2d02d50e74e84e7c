// The path loss table of each frame, over the heights in which a scene can send echoes.
//
// Its heights go from 10 m below the lowest ground, or the sensor, to 300 m above the highest:
// buildings and models rise above the ground. Higher tops are held to the last entry.
#pragma once

#include "renderer/casting/path_loss_table.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class FramePathLoss {
 public:
  // `world` must outlive it.
  explicit FramePathLoss(const World& world);

  PathLossTable from(double sensor_height_m) const;

 private:
  const World& world_;
  double lowest_m_ = 0.0, highest_m_ = 0.0;  // of the ground
};

}  // namespace fanbeam::renderer
