#include "benchmarks/frame_clock.h"

#include <benchmark/benchmark.h>

#include <memory>

#include "benchmarks/stopwatch.h"
#include "sensors/display/display.h"

namespace fanbeam::benchmarks {

FramePower power_of(renderer::Frame&& frame) {
  return {std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
}

FrameClock::FrameClock(const renderer::World& world, const renderer::FramePose& pose,
                       const renderer::Effects& effects, const renderer::Sampling& sampling)
    : sensor_(world.sensor), pose_(pose), renderer_(world, sampling, {}, effects) {}

FrameClock::FrameClock(const renderer::World& world, const renderer::FramePose& pose, bool noise,
                       const renderer::Sampling& sampling)
    : FrameClock(world, pose, renderer::Effects{.thermal_noise = noise}, sampling) {}

FrameClock::FrameClock(const View& view, renderer::NaiveKind kind, double rays,
                       const renderer::ElevationSpan& span)
    : sensor_(view.sensor()),
      pose_(view.pose),
      renderer_(
          view.world(),
          renderer::naive_sampling(kind, rays / (view.sensor().scan.columns *
                                                 static_cast<double>(view.sensor().range.cells))),
          {}, view.scene->effects(),
          std::make_unique<renderer::NaiveCaster>(view.world(), kind, rays, span)) {}

double FrameClock::frame_ms(renderer::Frame* frame) const {
  const Clock::time_point begin = Clock::now();
  renderer::Frame rendered = renderer_.render(pose_);
  benchmark::DoNotOptimize(sensors::bscope_picture(sensor_, rendered.bscope_grey));
  benchmark::DoNotOptimize(sensors::cscope_picture(sensor_, rendered.cscope_grey));
  const double time_ms = milliseconds_since(begin);
  if (frame != nullptr) *frame = std::move(rendered);
  return time_ms;
}

FramePower FrameClock::power() const { return power_of(renderer_.render(pose_)); }

double FrameClock::second_frame_ms() const {
  frame_ms();
  return frame_ms();
}

}  // namespace fanbeam::benchmarks
