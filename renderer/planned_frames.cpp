#include "renderer/planned_frames.h"

#include <initializer_list>

namespace fanbeam::renderer {
namespace {

unsigned bits(std::initializer_list<bool> flags) {
  unsigned number = 0;
  for (const bool flag : flags) number = 2 * number + (flag ? 1U : 0U);
  return number;
}

unsigned stages_of(const Effects& effects) {
  return bits({effects.thermal_noise, effects.speckle, effects.swerling, effects.rain_echo,
               effects.double_bounce, effects.multipath, effects.range_response});
}

unsigned number_of(const Products& products) {
  return bits({products.bscope, products.cscope, products.detections, products.obstacles,
               products.layers, products.cscope_layers});
}

}  // namespace

const FrameRenderer& PlannedFrames::for_plan(const core::EffectPlan& plan,
                                             const Products& products) {
  const Effects effects = effects_of(plan, seed_);
  const std::lock_guard<std::mutex> lock(making_);
  std::unique_ptr<FrameRenderer>& renderer = renderers_[{stages_of(effects), number_of(products)}];
  if (!renderer) renderer = std::make_unique<FrameRenderer>(world_, sampling_, products, effects);
  return *renderer;
}

}  // namespace fanbeam::renderer
