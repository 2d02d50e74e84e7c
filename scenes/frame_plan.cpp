#include "scenes/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "atmosphere/volume_echo.h"
#include "core/constants.h"
#include "core/errors.h"
#include "renderer/plan/frame_facts.h"
#include "renderer/stages/point_targets.h"
#include "scenes/sight_map.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::scenes {
namespace {

double reach_m(const atmosphere::RainCell& cell) {
  return cell.radius_m > 0.0 ? cell.radius_m : std::hypot(cell.length_m, cell.width_m) / 2.0;
}

std::vector<atmosphere::RainCell> cells_within(const std::vector<atmosphere::RainCell>& cells,
                                               const glm::dvec3& antenna_m, double range_m) {
  std::vector<atmosphere::RainCell> within;
  for (const atmosphere::RainCell& cell : cells)
    if (glm::distance(cell.centre_m, glm::dvec2(antenna_m)) <= range_m + reach_m(cell))
      within.push_back(cell);
  return within;
}

// Between the lowest and the highest place that the beam reaches. Level at the aircraft is not level
// at the scene's origin, and an antenna that is not stabilised is not level at all.
double largest_eta_m2_per_m3(const atmosphere::Weather& weather, const sensors::Sensor& sensor,
                             const sensors::AntennaFrame& antenna) {
  const double turn_rad = std::acos(std::clamp(antenna.up.z, -1.0, 1.0));
  const double reach_rad = sensors::reach_rad(sensor.antenna.elevation) + turn_rad;
  const double boresight_rad = sensor.antenna.boresight_elevation_rad;
  const double range_m = sensor.range.maximum_m();
  const auto height_m = [&](double elevation_rad) {
    return antenna.position_m.z +
           range_m * std::sin(std::clamp(elevation_rad, -core::kPi / 2.0, core::kPi / 2.0));
  };
  return atmosphere::VolumeEcho(weather, sensor.waveform.frequency_Hz)
      .largest_eta_m2_per_m3(std::min(antenna.position_m.z, height_m(boresight_rad - reach_rad)),
                             std::max(antenna.position_m.z, height_m(boresight_rad + reach_rad)));
}

}  // namespace

renderer::SceneFacts frame_facts(const Scene& scene, int frame_index) {
  if (!scene.sight) throw core::InternalError("frame plans of a scene that was built without them");
  const sensors::Sensor& sensor = scene.description.sensor;
  const renderer::FramePose pose = scene.frame_pose(frame_index);
  const sensors::AntennaFrame antenna = renderer::antenna_of(sensor, pose);
  const SightMap::Seen seen = scene.sight->seen_from(antenna, sensor);
  renderer::FrameSight sight;
  sight.lowest_m = std::min(seen.lowest_ground_m, antenna.position_m.z);
  sight.highest_m = std::max(seen.highest_ground_m, antenna.position_m.z);
  sight.mirrors = seen.mirrors;
  sight.mirrored_rays_end = seen.mirrored_rays_end;
  sight.ground_mirrors = seen.ground_mirrors;
  const renderer::TargetEchoes targets =
      renderer::unobstructed_echoes(scene.world, antenna, pose.time_s);
  for (const core::Echo& echo : targets.echoes) {
    const double height_m = scene.world.targets[echo.object_id].position_at(pose.time_s).z;
    sight.point_targets = true;
    sight.lowest_m = std::min(sight.lowest_m, height_m);
    sight.highest_m = std::max(sight.highest_m, height_m);
  }
  atmosphere::Weather weather = scene.facts.weather;
  weather.rain_cells =
      cells_within(weather.rain_cells, antenna.position_m, sensor.range.maximum_m());
  if (scene.facts.largest_eta_m2_per_m3 > 0.0)
    sight.largest_eta_m2_per_m3 = largest_eta_m2_per_m3(weather, sensor, antenna);
  sight.rain_cells = std::move(weather.rain_cells);
  return renderer::frame_facts(scene.facts, sight);
}

core::EffectPlan frame_plan(const Scene& scene, int frame_index) {
  return renderer::frame_plan(scene.plan, frame_facts(scene, frame_index), scene.accuracy_grey,
                              scene.wishes);
}

}  // namespace fanbeam::scenes
