#include "renderer/planned_frames.h"

#include "renderer/frame_renderer.h"

namespace fanbeam::renderer {

PlannedFrames::PlannedFrames(const World& world, const Sampling& sampling, std::uint64_t seed)
    : world_(world), sampling_(sampling), seed_(seed) {}

PlannedFrames::~PlannedFrames() = default;

Frame PlannedFrames::render(const core::EffectPlan& plan, const Products& products,
                            const FramePose& pose) {
  return renderer_for(plan, products).render(pose);
}

const FrameRenderer& PlannedFrames::renderer_for(const core::EffectPlan& plan,
                                                 const Products& products) {
  const Effects effects = effects_of(plan, seed_);
  const std::lock_guard<std::mutex> lock(making_);
  std::unique_ptr<FrameRenderer>& renderer = renderers_[{effects, products}];
  if (!renderer) renderer = std::make_unique<FrameRenderer>(world_, sampling_, products, effects);
  return *renderer;
}

}  // namespace fanbeam::renderer
