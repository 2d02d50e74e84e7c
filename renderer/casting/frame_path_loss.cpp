#include "renderer/casting/frame_path_loss.h"

#include <algorithm>

namespace fanbeam::renderer {

FramePathLoss::FramePathLoss(const World& world) : world_(world) {
  const terrain::HeightField* ground = world.surfaces().terrain();
  if (ground == nullptr) return;
  const auto [low, high] = std::minmax_element(ground->height_m.begin(), ground->height_m.end());
  lowest_m_ = *low;
  highest_m_ = *high;
}

PathLossTable FramePathLoss::from(double sensor_height_m) const {
  constexpr double kBelow_m = 10.0, kAbove_m = 300.0;
  return {world_.attenuation, sensor_height_m, std::min(sensor_height_m, lowest_m_) - kBelow_m,
          std::max(sensor_height_m, highest_m_) + kAbove_m};
}

}  // namespace fanbeam::renderer
