#include "measure/frame_clock.h"

#include <utility>

#include "measure/clock.h"
#include "renderer/frame_renderer.h"
#include "sensors/display/display.h"

namespace fanbeam::measure {

namespace {

double cells_of(const sensors::Sensor& sensor) {
  return static_cast<double>(sensor.scan.columns) * sensor.range.cells;
}

}  // namespace

renderer::FramePower power_of(renderer::Frame&& frame) {
  return {std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
}

FrameClock::FrameClock(const renderer::World& world, const renderer::FramePose& pose,
                       const renderer::Sampling& sampling, const renderer::Effects& effects)
    : sensor_(world.sensor),
      pose_(pose),
      renderer_(std::make_unique<renderer::FrameRenderer>(world, sampling, renderer::Products{},
                                                          effects)) {}

FrameClock::FrameClock(const renderer::World& world, const renderer::FramePose& pose,
                       renderer::NaiveKind kind, double rays_per_cell,
                       const renderer::ElevationSpan& span, const renderer::Effects& effects)
    : sensor_(world.sensor),
      pose_(pose),
      renderer_(std::make_unique<renderer::FrameRenderer>(
          world, renderer::naive_sampling(kind, rays_per_cell), renderer::Products{}, effects,
          std::make_unique<renderer::NaiveCaster>(world, kind,
                                                  rays_per_cell * cells_of(world.sensor), span))) {}

FrameClock::FrameClock(FrameClock&&) noexcept = default;
FrameClock::~FrameClock() = default;

renderer::FramePower FrameClock::power() const { return power_of(renderer_->render(pose_)); }

renderer::Frame FrameClock::render() const {
  renderer::Frame frame = renderer_->render(pose_);
  static_cast<void>(sensors::bscope_picture(sensor_, frame.bscope_grey));
  static_cast<void>(sensors::cscope_picture(sensor_, frame.cscope_grey));
  return frame;
}

double FrameClock::frame_ms(renderer::Frame* frame) const {
  const Clock::time_point begin = Clock::now();
  renderer::Frame rendered = render();
  const double time_ms = milliseconds_since(begin);
  if (frame != nullptr) *frame = std::move(rendered);
  return time_ms;
}

double FrameClock::second_frame_ms() const {
  frame_ms();
  return frame_ms();
}

}  // namespace fanbeam::measure
