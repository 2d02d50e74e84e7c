// One frame as it is timed: from the pose to both display images in memory.
#pragma once

#include <memory>

#include "renderer/accuracy/grey_error.h"
#include "renderer/accuracy/naive_caster.h"
#include "renderer/frame.h"

namespace fanbeam::renderer {
class FrameRenderer;
}

namespace fanbeam::measure {

renderer::FramePower power_of(renderer::Frame&& frame);

class FrameClock {
 public:
  // `world` must outlive it.
  FrameClock(const renderer::World& world, const renderer::FramePose& pose,
             const renderer::Sampling& sampling, const renderer::Effects& effects);
  // By a naive renderer with so many rays per range cell and column of the picture.
  FrameClock(const renderer::World& world, const renderer::FramePose& pose,
             renderer::NaiveKind kind, double rays, const renderer::ElevationSpan& span,
             const renderer::Effects& effects);
  FrameClock(FrameClock&&) noexcept;
  ~FrameClock();

  // All that is timed.
  renderer::Frame render() const;
  // The same with a clock; the frame goes to `frame` unless that is null.
  double frame_ms(renderer::Frame* frame = nullptr) const;
  // The second of two frames: caches and threads are as they are within a sequence, whatever ran
  // before.
  double second_frame_ms() const;

  // Of frames whose time does not matter.
  renderer::FramePower power() const;
  renderer::FrameError error(const renderer::GreyReference& reference) const {
    return reference.error_of(power());
  }

 private:
  const sensors::Sensor& sensor_;
  renderer::FramePose pose_;
  std::unique_ptr<renderer::FrameRenderer> renderer_;
};

}  // namespace fanbeam::measure
