// Renderers for sequences whose frames go through different stages (renderer::frame_plan): one for
// each combination of stages, made when a frame first asks for it.
//
// All of them look at one world, so switching costs nothing from then on. A combination costs the
// tables of one FrameRenderer: milliseconds and a few megabytes; there are at most eight.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "core/effect_plan.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::renderer {

class PlannedFrames {
 public:
  // `world` must outlive this, and have been built for what every plan runs.
  PlannedFrames(const World& world, const Sampling& sampling, const Products& products,
                std::uint64_t seed)
      : world_(world), sampling_(sampling), products_(products), seed_(seed) {}

  // Valid as long as this object. Not thread-safe; the renderer is.
  const FrameRenderer& for_plan(const core::EffectPlan& plan);

 private:
  const World& world_;
  Sampling sampling_;
  Products products_;
  std::uint64_t seed_;
  std::map<unsigned, std::unique_ptr<FrameRenderer>> renderers_;  // by the stages that run
};

}  // namespace fanbeam::renderer
