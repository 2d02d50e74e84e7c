#include "renderer/planned_frames.h"

namespace fanbeam::renderer {

const FrameRenderer& PlannedFrames::for_plan(const core::EffectPlan& plan,
                                             const Products& products) {
  const Effects effects = effects_of(plan, seed_);
  const std::lock_guard<std::mutex> lock(making_);
  std::unique_ptr<FrameRenderer>& renderer = renderers_[{effects, products}];
  if (!renderer) renderer = std::make_unique<FrameRenderer>(world_, sampling_, products, effects);
  return *renderer;
}

}  // namespace fanbeam::renderer
