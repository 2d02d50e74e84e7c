// Clocks of views.
#pragma once

#include "benchmarks/bench_scene.h"
#include "measure/clock.h"
#include "measure/frame_clock.h"

namespace fanbeam::benchmarks {

using measure::FrameClock;
using measure::power_of;
using renderer::FrameError;
using renderer::FrameGrey;
using renderer::FramePower;
using renderer::GreyError;
using renderer::GreyReference;
using renderer::PictureError;

// Of the whole picture.
inline FrameClock clock_of(const View& view, const renderer::Sampling& sampling) {
  return {view.world(), view.pose, sampling, view.scene->effects()};
}

// Of surfaces and point targets alone.
inline FrameClock surfaces_clock(const renderer::World& world, const View& view,
                                 const renderer::Sampling& sampling) {
  return {world, view.pose, sampling, view.scene->noise_alone()};
}

}  // namespace fanbeam::benchmarks
