// What casts shadows in a scene, by rays, beside what the B-scope's shadows tell.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "renderer/frame_renderer.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "sensors/cells.h"
#include "sensors/shadow/shadow_obstacles.h"

namespace fanbeam::tests {

// Tally of one object over a run of frames.
struct ShadowScore {
  int free = 0;    // frames in which its shadow ends on level ground inside the range gate
  int seen = 0;    // of these: reported, with or without a height
  int found = 0;   // of these: with a height
  int within = 0;  // of these: height within 1 m or a range cell's worth
  double worst_m = 0.0;
  std::vector<double> errors_m;

  double median_error_m() const {
    std::vector<double> sorted(errors_m);
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  }
};

struct ShadowTally {
  int frames = 0;
  std::map<std::string, ShadowScore> boxes;
  // Everything else with a height: found where a building stands, or where the ground or a wood
  // drops by 3 m or more; how many shadows are free is not known.
  ShadowScore buildings, woods;
  int uncertain = 0;      // obstacles without a height
  int false_alarms = 0;   // obstacles where nothing stands
  int false_heights = 0;  // of these: with a height

  int heights = 0, within = 0;  // of all heights given, boxes included and false ones too
};

class ShadowTruth {
 public:
  explicit ShadowTruth(const scenes::Scene& scene) : scene_(scene) {
    const scenes::RunwayDescription& runway = scene.description.runways.front();
    const int end = scene.description.trajectory.ils_end == runway.ends[0].name ? 0 : 1;
    const glm::dvec3 from = scene.frame.to_local_m(runway.ends[end].pavement_end);
    const glm::dvec3 to = scene.frame.to_local_m(runway.ends[1 - end].pavement_end);
    along_ = glm::normalize(glm::dvec2(to - from));
    threshold_m_ = glm::dvec2(from) + along_ * runway.ends[end].displaced_m;
    pose(0);
  }

  void pose(int frame) {
    const renderer::FramePose pose = scene_.frame_pose(frame);
    const sensors::Sensor& sensor = scene_.world.sensor;
    antenna_ = sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB,
                                      sensor.mounting, sensor.scan.stabilised);
    height_m_ = antenna_.position_m.z - ground_m(glm::dvec2(antenna_.position_m));
  }

  double height_m() const { return height_m_; }

  // Where the shadow of the box's far top edge ends, slant, when that is ground inside the range
  // gate within 1 m of the height of the box's foot.
  std::optional<double> free_shadow_end_m(const scenes::BoxDescription& box) const {
    const glm::dvec2 centre = place_m(box);
    const glm::dvec2 away = glm::normalize(centre - glm::dvec2(antenna_.position_m));
    const double foot_m = ground_m(centre);
    const glm::dvec3 top(centre + away * half_depth_m(box, away), foot_m + box.height_m + 0.05);
    const glm::dvec3 path = top - antenna_.position_m;
    if (!(path.z < 0.0)) return std::nullopt;
    const auto hit =
        scene_.world.surfaces().intersect(antenna_.position_m, glm::normalize(path), 2.0e4);
    if (!hit || hit->geometry != terrain::kTerrainGeometry) return std::nullopt;
    const glm::dvec3 end = antenna_.position_m + glm::normalize(path) * hit->distance_m;
    const sensors::RangeGate& gate = scene_.world.sensor.range;
    if (hit->distance_m > gate.maximum_m() - 3.0 * gate.cell_m) return std::nullopt;
    if (std::abs(end.z - foot_m) > 1.0) return std::nullopt;
    return hit->distance_m;
  }

  bool is_at(const sensors::ShadowObstacle& obstacle, const scenes::BoxDescription& box) const {
    const glm::dvec2 centre = place_m(box);
    const auto angles =
        sensors::angles(antenna_, glm::dvec3(centre, ground_m(centre)) - antenna_.position_m,
                        scene_.world.sensor.scan.surface);
    if (!angles) return false;
    const glm::dvec2 away = glm::normalize(centre - glm::dvec2(antenna_.position_m));
    const double range_m = glm::length(glm::dvec3(centre, ground_m(centre)) - antenna_.position_m);
    const double half_width_rad = half_depth_m(box, {-away.y, away.x}) / range_m;
    return std::abs(obstacle.azimuth_rad - angles->azimuth_rad) <
               half_width_rad + core::radians(0.4) &&
           std::abs(obstacle.range_m - range_m) < half_depth_m(box, away) + 20.0;
  }

  // What casts the shadow of an obstacle: the edge that most of the columns' rays pass on their way
  // to what lies behind. Height over the ground at that edge; over the ground 25 m behind it where
  // the edge belongs to the terrain, whose surface holds the woods.
  struct Caster {
    bool building = false;
    double height_m = 0.0;
  };
  std::optional<Caster> caster(const sensors::ShadowObstacle& obstacle) const {
    const double top_m = obstacle.shadow_length_m * (height_m_ / obstacle.height_m - 1.0);
    const sensors::Scan& scan = scene_.world.sensor.scan;
    std::vector<double> buildings_m, drops_m;
    for (int column = obstacle.first_column; column <= obstacle.last_column; ++column)
      for (const double part : {0.0, -0.5, 0.5}) {
        const auto k = static_cast<std::size_t>(column - obstacle.first_column);
        const double shift_m = obstacle.column_range_m[k] - obstacle.range_m;
        const auto edge =
            edge_along(sensors::column_middle_rad(scan, column) + part * scan.column_width_rad(),
                       top_m + shift_m, top_m + shift_m + obstacle.shadow_length_m);
        if (edge) (edge->building ? buildings_m : drops_m).push_back(edge->height_m);
      }
    std::vector<double>& heights_m = buildings_m.empty() ? drops_m : buildings_m;
    if (heights_m.empty()) return std::nullopt;
    std::sort(heights_m.begin(), heights_m.end());
    return Caster{!buildings_m.empty(), heights_m[heights_m.size() / 2]};
  }

 private:
  // Of the gaps in range that rays of rising elevation find along one azimuth, the near side of the
  // one that shares most with [top_m, end_m].
  std::optional<Caster> edge_along(double azimuth_rad, double top_m, double end_m) const {
    constexpr double kStep_rad = 1e-4;  // 1.3 m of ground at 2 km from 300 m height
    constexpr double kGap_m = 13.0;     // two range cells
    const auto depth_rad = [&](double range_m) {
      return std::asin(std::min(height_m_ / range_m, 1.0));
    };
    std::optional<Caster> best;
    double longest_m = 0.0, last_m = 0.0;
    glm::dvec3 last(0.0);
    bool building = false;
    for (double rad = -depth_rad(std::max(top_m - 400.0, 1.0)); rad < 0.05; rad += kStep_rad) {
      const glm::dvec3 ahead =
          sensors::direction(antenna_, azimuth_rad, rad, scene_.world.sensor.scan.surface);
      const auto hit = scene_.world.surfaces().intersect(antenna_.position_m, ahead, 2.0e4);
      const double range_m = hit ? hit->distance_m : 2.0e4;
      const double shared_m = std::min(range_m, end_m) - std::max(last_m, top_m);
      if (last_m > top_m - 100.0 && range_m - last_m > kGap_m && shared_m > longest_m) {
        longest_m = shared_m;
        const glm::dvec2 away = glm::normalize(glm::dvec2(ahead));
        const glm::dvec2 foot = glm::dvec2(last) + (building ? 0.0 : 25.0) * away;
        best = Caster{building, last.z - ground_m(foot)};
      }
      if (!hit || range_m > end_m + 400.0) break;
      last = antenna_.position_m + ahead * range_m;
      last_m = range_m;
      building = hit->geometry != terrain::kTerrainGeometry;
    }
    return best;
  }

  double ground_m(glm::dvec2 at) const {
    return scene_.world.surfaces().terrain()->height_at(at.x, at.y).value_or(0.0);
  }
  glm::dvec2 place_m(const scenes::BoxDescription& box) const {
    return threshold_m_ + along_ * box.at.behind_threshold_m +
           glm::dvec2(-along_.y, along_.x) * box.at.left_m;
  }
  // Half of the box along a line through its middle.
  static double half_depth_m(const scenes::BoxDescription& box, glm::dvec2 line) {
    const double c =
        std::abs(line.x * std::sin(box.heading_rad) + line.y * std::cos(box.heading_rad));
    const double s =
        std::abs(line.x * std::cos(box.heading_rad) - line.y * std::sin(box.heading_rad));
    return std::min(c > 0.0 ? 0.5 * box.length_m / c : 1e9, s > 0.0 ? 0.5 * box.width_m / s : 1e9);
  }
  const scenes::Scene& scene_;
  glm::dvec2 along_{0.0, 1.0}, threshold_m_{0.0};
  sensors::AntennaFrame antenna_;
  double height_m_ = 0.0;
};

inline void score(double estimate_m, double truth_m, double cell_m, ShadowScore& score) {
  const double error_m = estimate_m - truth_m;
  ++score.found;
  score.errors_m.push_back(error_m);
  score.worst_m = std::max(score.worst_m, std::abs(error_m));
  if (std::abs(error_m) <= std::max(1.0, cell_m)) ++score.within;
}

inline void add(double truth_m, const sensors::ShadowObstacle& obstacle, ShadowTally& tally) {
  ++tally.heights;
  if (std::abs(obstacle.height_m - truth_m) <= std::max(1.0, obstacle.height_error_m))
    ++tally.within;
}

// Every `step`-th frame of the flight down to 20 m above the ground.
inline ShadowTally tally_shadows(const scenes::Scene& scene, int step) {
  renderer::Effects on = renderer::effects_of(scene.plan, 1);
  const renderer::FrameRenderer frames(
      scene.world, renderer::sampling_for(4.0),
      {.bscope = false, .cscope = false, .detections = false, .obstacles = true}, on);
  ShadowTruth truth(scene);
  ShadowTally tally;
  for (int frame = 0; frame < scene.frame_count(); frame += step) {
    truth.pose(frame);
    if (truth.height_m() < 20.0) break;
    ++tally.frames;
    std::vector<sensors::ShadowObstacle> left = frames.render(scene.frame_pose(frame)).obstacles;
    for (const scenes::BoxDescription& box : scene.description.boxes) {
      const bool free = truth.free_shadow_end_m(box).has_value();
      ShadowScore& of_box = tally.boxes[box.name];
      of_box.free += free ? 1 : 0;
      const auto at = std::partition(left.begin(), left.end(), [&](const auto& obstacle) {
        return !truth.is_at(obstacle, box);
      });
      // The tallest with a height, if there is one.
      const auto best = std::max_element(at, left.end(), [](const auto& a, const auto& b) {
        return std::pair(!a.uncertain, a.height_m) < std::pair(!b.uncertain, b.height_m);
      });
      if (best == left.end()) continue;
      of_box.seen += free ? 1 : 0;
      if (free && !best->uncertain)
        score(best->height_m, box.height_m, best->height_error_m, of_box);
      // A box may be found in parts; each has its say in what is given altogether.
      for (auto part = at; part != left.end(); ++part) {
        if (!part->uncertain) add(box.height_m, *part, tally);
        tally.uncertain += part->uncertain ? 1 : 0;
      }
      left.erase(at, left.end());
    }
    for (const sensors::ShadowObstacle& obstacle : left) {
      const auto caster = truth.caster(obstacle);
      const bool nothing = !caster || caster->height_m < (caster->building ? 2.0 : 3.0);
      tally.false_alarms += nothing ? 1 : 0;
      tally.uncertain += obstacle.uncertain ? 1 : 0;
      if (obstacle.uncertain) continue;
      tally.false_heights += nothing ? 1 : 0;
      add(nothing ? 0.0 : caster->height_m, obstacle, tally);
      if (!nothing)
        score(obstacle.height_m, caster->height_m, obstacle.height_error_m,
              caster->building ? tally.buildings : tally.woods);
    }
  }
  return tally;
}

}  // namespace fanbeam::tests
