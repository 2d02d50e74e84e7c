// Frames of one world that go through different stages (scenes::frame_plan) or ask for different
// products: a renderer for each combination, made when a frame first asks for it.
//
// A combination costs the tables of one FrameRenderer: milliseconds and a few megabytes. Plans of
// one sequence make at most eight, as they differ in three stages alone and agree on all that is
// built into the world (renderer::frame_plan), and products sixty-four.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/effect_plan.h"
#include "renderer/frame.h"

namespace fanbeam::renderer {

class FrameRenderer;

class PlannedFrames {
 public:
  // `world` must outlive this, and have been built for what every plan runs.
  PlannedFrames(const World& world, const Sampling& sampling, std::uint64_t seed);
  ~PlannedFrames();

  // Thread-safe; who asks while another renderer is made waits for it. Errors: those of
  // FrameRenderer.
  Frame render(const core::EffectPlan& plan, const Products& products, const FramePose& pose);

 private:
  const FrameRenderer& renderer_for(const core::EffectPlan& plan, const Products& products);

  const World& world_;
  Sampling sampling_;
  std::uint64_t seed_;
  std::mutex making_;
  std::map<std::pair<Effects, Products>, std::unique_ptr<FrameRenderer>> renderers_;
};

}  // namespace fanbeam::renderer
