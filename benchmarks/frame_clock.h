// Times frames as the project states them: from the pose to both display images in memory.
#pragma once

#include "benchmarks/bench_scene.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::benchmarks {

class FrameClock {
 public:
  // `view` must outlive the clock.
  FrameClock(const View& view, const renderer::Sampling& sampling);

  // Renders B-scope and C-scope once; the frame goes to `frame` unless that is null.
  double frame_ms(renderer::Frame* frame = nullptr) const;

 private:
  const View& view_;
  renderer::FrameRenderer renderer_;
};

}  // namespace fanbeam::benchmarks
