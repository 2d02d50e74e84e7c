// Times frames as the project states them: from the pose to both display images in memory.
#pragma once

#include "benchmarks/bench_scene.h"
#include "renderer/accuracy/grey_error.h"
#include "renderer/accuracy/naive_caster.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::benchmarks {

using renderer::FrameError;
using renderer::FrameGrey;
using renderer::FramePower;
using renderer::GreyError;
using renderer::GreyReference;
using renderer::PictureError;

FramePower power_of(renderer::Frame&& frame);

class FrameClock {
 public:
  // `world` must outlive the clock.
  FrameClock(const renderer::World& world, const renderer::FramePose& pose,
             const renderer::Effects& effects, const renderer::Sampling& sampling);
  // Surfaces and point targets alone.
  FrameClock(const renderer::World& world, const renderer::FramePose& pose, bool noise,
             const renderer::Sampling& sampling);
  // The whole picture.
  FrameClock(const View& view, const renderer::Sampling& sampling)
      : FrameClock(view.world(), view.pose, view.scene->effects(), sampling) {}
  // About `rays` naive rays, and the same effects.
  FrameClock(const View& view, renderer::NaiveKind kind, double rays,
             const renderer::ElevationSpan& span);

  // Renders B-scope and C-scope once; the frame goes to `frame` unless that is null.
  double frame_ms(renderer::Frame* frame = nullptr) const;

  // Of one frame, whose time does not matter.
  FramePower power() const;

  // The second of two frames: caches and threads are as they are within a sequence, whatever ran
  // before.
  double second_frame_ms() const;

 private:
  const sensors::Sensor& sensor_;
  renderer::FramePose pose_;
  renderer::FrameRenderer renderer_;
};

}  // namespace fanbeam::benchmarks
