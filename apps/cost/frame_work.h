// One frame as it is timed: from the pose to both display images in memory.
#pragma once

#include <memory>

#include "renderer/accuracy/grey_error.h"
#include "renderer/accuracy/naive_caster.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::apps {

// The expected picture: a realisation cannot be held against a converged one.
renderer::Effects without_draws(renderer::Effects effects);

class FrameWork {
 public:
  // `world` must outlive it.
  FrameWork(const renderer::World& world, const renderer::FramePose& pose,
            const renderer::Sampling& sampling, const renderer::Effects& effects);
  // By a naive renderer with so many rays per range cell and column of the picture.
  FrameWork(const renderer::World& world, const renderer::FramePose& pose, renderer::NaiveKind kind,
            double rays, const renderer::ElevationSpan& span, const renderer::Effects& effects);

  renderer::Frame render() const;
  // The same, and judged.
  renderer::FrameError error(const renderer::GreyReference& reference) const;

 private:
  const sensors::Sensor& sensor_;
  renderer::FramePose pose_;
  std::unique_ptr<renderer::FrameRenderer> renderer_;
};

}  // namespace fanbeam::apps
