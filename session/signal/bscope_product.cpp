#include "session/signal/bscope_product.h"

#include <fmt/core.h>

#include <utility>

#include "core/effect_plan.h"
#include "core/image.h"
#include "sensors/display/display.h"
#include "session/products/frame_writer.h"

namespace fanbeam::session {

SignalBscope fmcw_bscope(const scenes::Scene& scene, int frame, const FmcwSettings& options) {
  const core::Pose pose = scene.trajectory->at(
      scene.trajectory->frame_time_s(frame, scene.description.sensor.scan.frame_rate_Hz));
  const renderer::FramePose frame_pose = scene.frame_pose(frame);
  SignalBscopeSettings settings;
  settings.rays_per_cell = options.rays_per_cell;
  settings.looks = options.looks;
  settings.own_velocity_mps = frame_pose.north_east_down * pose.v_N_mps;
  if (scene.plan.runs(core::EffectId::multipath))
    settings.multipath = renderer::Multipath::coherent;
  settings.swerling = scene.plan.runs(core::EffectId::swerling);
  settings.budget = signal_budget(scene);
  settings.receiver = options;
  settings.seed = options.seed;
  return signal_bscope(scene.world, frame_pose, settings);
}

std::set<std::string> write_bscope(const std::filesystem::path& folder,
                                   const sensors::Sensor& sensor, int frame,
                                   const SignalBscope& bscope) {
  const core::Metadata metadata = {{"fanbeam:product", "bscope"},
                                   {"fanbeam:frame", std::to_string(frame)},
                                   {"fanbeam:looks", std::to_string(bscope.looks)}};
  const std::string name = fmt::format("bscope/{:05}", frame);
  core::write_png(folder / (name + ".png"),
                  sensors::bscope_picture(sensor, sensors::bscope_grey(sensor, bscope.power_W)),
                  metadata);
  core::Image image{sensor.scan.columns, sensor.range.cells, {}};
  image.layers.push_back({"power_W", farthest_on_top(bscope.power_W, sensor.scan.columns)});
  core::write_exr(folder / (name + ".exr"), image, metadata);
  return {name + ".png", name + ".exr"};
}

}  // namespace fanbeam::session
