#include "benchmarks/frame_clock.h"

#include <benchmark/benchmark.h>

#include "benchmarks/stopwatch.h"
#include "sensors/display/display.h"

namespace fanbeam::benchmarks {

FrameClock::FrameClock(const View& view, const renderer::Sampling& sampling)
    : view_(view), renderer_(view.world(), sampling, {}, {.thermal_noise = view.scene->noise()}) {}

double FrameClock::frame_ms(renderer::Frame* frame) const {
  const Clock::time_point begin = Clock::now();
  renderer::Frame rendered = renderer_.render(view_.pose);
  benchmark::DoNotOptimize(sensors::bscope_picture(view_.sensor(), rendered.bscope_grey));
  benchmark::DoNotOptimize(sensors::cscope_picture(view_.sensor(), rendered.cscope_grey));
  const double time_ms = milliseconds_since(begin);
  if (frame != nullptr) *frame = std::move(rendered);
  return time_ms;
}

}  // namespace fanbeam::benchmarks
