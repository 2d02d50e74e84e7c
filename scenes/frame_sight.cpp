#include "scenes/frame_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "atmosphere/volume_echo.h"
#include "core/constants.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/point_targets.h"
#include "scenes/sight_fan.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/antenna/column_place.h"

namespace fanbeam::scenes {
namespace {

using atmosphere::RainCell;

double reach_m(const RainCell& cell) {
  return cell.radius_m > 0.0 ? cell.radius_m : std::hypot(cell.length_m, cell.width_m) / 2.0;
}

template <class May>
std::vector<RainCell> those(const std::vector<RainCell>& cells, const May& may) {
  std::vector<RainCell> result;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(result), may);
  return result;
}

// Whether anything is seen past the fan: by rays that corners mirror, anywhere within range; or a
// target in the antenna's side lobes, or so steeply above or below that its beam reaches far aside.
// The mirror image of a target is no third: its echo has the losses of the straight way to the target
// (ground_multipath.h), which lies in the fan when the target does.
bool sees_beside(const renderer::SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  return renderer::corners_possible(facts) ||
         (facts.has_point_targets &&
          sensors::azimuth_reach_rad(sensor, sensors::steepest_rad(sensor)) >
              fan_margin_rad(sensor));
}

// Whether rays of the fan, and with `beside` others as well, may pass the cell. A way out, by mirrors
// and back is twice as long as the range of its echo, and goes no farther away than half of that.
bool may_pass(const RainCell& cell, const SightMap& map, const sensors::Sensor& sensor,
              const sensors::AntennaFrame& antenna, bool beside) {
  constexpr double kRounding_m = 1.0;
  const double shown_m =
      sensor.range.maximum_m() + renderer::kSpreadCells * sensor.range.cell_m + kRounding_m;
  const double away_m = glm::distance(cell.centre_m, glm::dvec2(antenna.position_m));
  if (away_m > shown_m + reach_m(cell)) return false;
  return beside || map.fan_may_meet(antenna, sensor, cell.centre_m, reach_m(cell));
}

double largest_eta_m2_per_m3(const atmosphere::Weather& weather, const sensors::Sensor& sensor,
                             const sensors::AntennaFrame& antenna) {
  const sensors::HeightSpan beam = sensors::heights_in_beam(antenna, sensor);
  return atmosphere::VolumeEcho(weather, sensor.waveform.frequency_Hz)
      .largest_eta_m2_per_m3(beam.lowest_m, beam.highest_m);
}

// Adds what one frame sees of mirrors; the heights are its own.
void see_mirrors(const SightMap& map, const sensors::Sensor& sensor,
                 const sensors::AntennaFrame& antenna, renderer::FrameSight& sight) {
  const SightMap::Seen seen = map.seen_from(antenna, sensor);
  sight.lowest_m = std::min(seen.lowest_ground_m, antenna.position_m.z);
  sight.highest_m = std::max(seen.highest_ground_m, antenna.position_m.z);
  sight.mirrors |= seen.mirrors;
  sight.mirrored_rays_end |= seen.mirrored_rays_end;
  sight.ground_mirrors |= seen.ground_mirrors;
}

bool mirrors_are_seen(const renderer::SceneFacts& scene, const renderer::FrameSight& sight) {
  return (!renderer::corners_possible(scene) || (sight.mirrors && sight.mirrored_rays_end)) &&
         (!renderer::mirrored_targets_possible(scene) || sight.ground_mirrors);
}

// Weather that some frame sees: the cells in `facts`, and the largest eta of what lies in the fan.
void narrow_weather(const SightMap& map, const std::vector<renderer::FramePose>& poses,
                    renderer::SceneFacts& facts) {
  const std::vector<RainCell> cells = facts.weather.rain_cells;
  const sensors::Sensor& sensor = facts.sensor;
  const auto seen_with = [&](bool beside) {
    return those(cells, [&](const RainCell& cell) {
      return std::any_of(poses.begin(), poses.end(), [&](const auto& pose) {
        return may_pass(cell, map, sensor, renderer::antenna_of(sensor, pose), beside);
      });
    });
  };
  facts.weather.rain_cells = seen_with(false);
  if (facts.weather.rain_cells.size() < cells.size())
    facts.largest_eta_m2_per_m3 =
        std::min(facts.largest_eta_m2_per_m3,
                 atmosphere::VolumeEcho(facts.weather, sensor.waveform.frequency_Hz)
                     .largest_eta_m2_per_m3());
  if (sees_beside(facts)) facts.weather.rain_cells = seen_with(true);
}

}  // namespace

renderer::FrameSight frame_sight(const renderer::SceneFacts& scene, const SightMap& map,
                                 const std::vector<renderer::PointTarget>& targets,
                                 const sensors::AntennaFrame& antenna, double time_s) {
  const sensors::Sensor& sensor = scene.sensor;
  renderer::FrameSight sight;
  see_mirrors(map, sensor, antenna, sight);
  for (const renderer::PointTarget& target : targets) {
    if (!renderer::in_view(sensor, target, antenna, time_s)) continue;
    const double height_m = target.position_at(time_s).z;
    sight.point_targets = true;
    sight.lowest_m = std::min(sight.lowest_m, height_m);
    sight.highest_m = std::max(sight.highest_m, height_m);
  }
  sight.leaves_ground = map.ends_within_range(antenna, sensor);
  const std::vector<RainCell>& cells = scene.weather.rain_cells;
  atmosphere::Weather weather = scene.weather;
  const auto passed = [&](bool beside) {
    return those(
        cells, [&](const RainCell& cell) { return may_pass(cell, map, sensor, antenna, beside); });
  };
  weather.rain_cells = passed(false);
  sight.rain_cells = weather.rain_cells;
  if (scene.largest_eta_m2_per_m3 > 0.0)
    sight.largest_eta_m2_per_m3 = largest_eta_m2_per_m3(weather, sensor, antenna);
  if (sees_beside(renderer::seen_facts(scene, sight))) sight.rain_cells = passed(true);
  return sight;
}

renderer::SceneFacts sequence_facts(const renderer::SceneFacts& scene, const SightMap& map,
                                    const std::vector<renderer::PointTarget>& targets, int frames,
                                    const std::function<renderer::FramePose(int)>& pose_of) {
  const sensors::Sensor& sensor = scene.sensor;
  renderer::FrameSight sight;
  bool all_mirrors = mirrors_are_seen(scene, sight);
  // Most flights end where the most is seen.
  for (int frame = frames - 1; frame >= 0; --frame) {
    const renderer::FramePose pose = pose_of(frame);
    const sensors::AntennaFrame antenna = renderer::antenna_of(sensor, pose);
    if (!all_mirrors) {
      see_mirrors(map, sensor, antenna, sight);
      all_mirrors = mirrors_are_seen(scene, sight);
    }
    if (!sight.point_targets)
      sight.point_targets = std::any_of(targets.begin(), targets.end(), [&](const auto& target) {
        return renderer::in_view(sensor, target, antenna, pose.time_s);
      });
    sight.leaves_ground = sight.leaves_ground || map.ends_within_range(antenna, sensor);
    if (all_mirrors && sight.leaves_ground && (sight.point_targets || targets.empty())) break;
  }
  sight.lowest_m = scene.lowest_m;
  sight.highest_m = scene.highest_m;
  sight.rain_cells = scene.weather.rain_cells;
  sight.largest_eta_m2_per_m3 = scene.largest_eta_m2_per_m3;
  renderer::SceneFacts facts = renderer::seen_facts(scene, sight);
  if (facts.weather.rain_cells.empty()) return facts;
  std::vector<renderer::FramePose> poses;
  for (int frame = 0; frame < frames; ++frame) poses.push_back(pose_of(frame));
  narrow_weather(map, poses, facts);
  return facts;
}

}  // namespace fanbeam::scenes
