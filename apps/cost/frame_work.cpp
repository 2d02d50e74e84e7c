#include "apps/cost/frame_work.h"

#include <utility>

#include "sensors/display/display.h"

namespace fanbeam::apps {

namespace {

double cells_of(const sensors::Sensor& sensor) {
  return static_cast<double>(sensor.scan.columns) * sensor.range.cells;
}

}  // namespace

renderer::Effects without_draws(renderer::Effects effects) {
  effects.speckle = effects.swerling = false;
  return effects;
}

FrameWork::FrameWork(const renderer::World& world, const renderer::FramePose& pose,
                     const renderer::Sampling& sampling, const renderer::Effects& effects)
    : sensor_(world.sensor),
      pose_(pose),
      renderer_(std::make_unique<renderer::FrameRenderer>(world, sampling, renderer::Products{},
                                                          effects)) {}

FrameWork::FrameWork(const renderer::World& world, const renderer::FramePose& pose,
                     renderer::NaiveKind kind, double rays_per_cell,
                     const renderer::ElevationSpan& span, const renderer::Effects& effects)
    : sensor_(world.sensor),
      pose_(pose),
      renderer_(std::make_unique<renderer::FrameRenderer>(
          world, renderer::naive_sampling(kind, rays_per_cell), renderer::Products{}, effects,
          std::make_unique<renderer::NaiveCaster>(world, kind,
                                                  rays_per_cell * cells_of(world.sensor), span))) {}

renderer::Frame FrameWork::render() const {
  renderer::Frame frame = renderer_->render(pose_);
  static_cast<void>(sensors::bscope_picture(sensor_, frame.bscope_grey));
  static_cast<void>(sensors::cscope_picture(sensor_, frame.cscope_grey));
  return frame;
}

renderer::FrameError FrameWork::error(const renderer::GreyReference& reference) const {
  renderer::Frame frame = render();
  return reference.error_of({std::move(frame.bscope_W), std::move(frame.cscope_W_m3)});
}

}  // namespace fanbeam::apps
