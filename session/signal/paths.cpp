#include "session/signal/paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/effect_plan.h"
#include "renderer/stages/frame_echoes.h"
#include "sensors/antenna/beam_pattern.h"
#include "session/signal/interferers.h"

namespace fanbeam::session {
namespace {

bool scans(const sensors::Sensor& sensor) {
  return sensor.scan.field_of_view_rad > 2.0 * sensor.antenna.azimuth.cut_rad;
}

double half_fan_rad(const sensors::Sensor& sensor) {
  const double half_rad = sensor.scan.field_of_view_rad / 2;
  return std::min(scans(sensor) ? half_rad : sensor.antenna.azimuth.cut_rad, core::kPi / 2);
}

}  // namespace

double element_gain(const sensors::Sensor& sensor, double azimuth_rad) {
  if (scans(sensor)) return std::abs(azimuth_rad) <= sensor.scan.field_of_view_rad / 2 ? 1.0 : 0.0;
  return sensors::one_way_gain_with_side_lobes(sensor.antenna.azimuth, azimuth_rad);
}

RadarVelocity_mps own_velocity_mps(const scenes::Scene& scene, int frame) {
  const renderer::FramePose pose = scene.frame_pose(frame);
  const glm::dvec3 velocity_mps = pose.north_east_down * scene.trajectory->at(pose.time_s).v_N_mps;
  const sensors::AntennaFrame antenna = renderer::antenna_of(scene.world.sensor, pose);
  return {glm::dot(velocity_mps, antenna.forward), glm::dot(velocity_mps, antenna.right)};
}

FmcwPaths fmcw_paths(const scenes::Scene& scene, int frame, const FmcwSettings& options) {
  const sensors::Sensor& sensor = scene.world.sensor;  // with side lobes where they are planned
  const core::Pose pose =
      scene.trajectory->at(scene.trajectory->frame_time_s(frame, sensor.scan.frame_rate_Hz));
  const renderer::FramePose frame_pose = scene.frame_pose(frame);
  renderer::FrameEchoSettings settings;
  settings.sampling.sub_columns = 1;
  settings.sampling.rays_per_cell = options.rays_per_cell;
  settings.half_fan_rad = half_fan_rad(sensor);
  settings.own_velocity_mps = frame_pose.north_east_down * pose.v_N_mps;
  if (scene.plan.runs(core::EffectId::multipath))
    settings.multipath = renderer::Multipath::coherent;
  settings.swerling = scene.plan.runs(core::EffectId::swerling);
  settings.seed = options.seed;
  const renderer::FrameEchoes all = renderer::frame_echoes(scene.world, frame_pose, settings);
  FmcwPaths result;
  result.rays = all.rays;
  result.events = all.events;
  result.paths.reserve(all.echoes.size());
  for (std::size_t i = 0; i < all.echoes.size(); ++i) {
    const core::Echo& echo = all.echoes[i];
    // A linear array cannot tell front from back: neither surfaces nor targets behind it.
    if (std::abs(echo.azimuth_rad) > core::kPi / 2) continue;
    const double gain = element_gain(sensor, echo.azimuth_rad);
    if (!(gain > 0.0)) continue;
    if (i >= all.first_target) {
      result.targets.push_back(echo);
      result.targets.back().power_W *= gain * gain;  // as in the samples
    }
    result.paths.push_back({echo.range_m, echo.radial_speed_mps, echo.azimuth_rad,
                            echo.elevation_rad,
                            std::polar(gain * std::sqrt(echo.power_W), all.phase_rad[i])});
  }
  result.interferers = interferers_of(scene, frame, result.targets);
  return result;
}

}  // namespace fanbeam::session
