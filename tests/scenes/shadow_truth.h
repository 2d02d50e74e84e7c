// What casts shadows in a scene, by rays, beside what the B-scope's shadows tell.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/units.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "sensors/cells.h"
#include "sensors/shadow/shadow_obstacles.h"

namespace fanbeam::tests {

// Tally of one object over a run of frames.
struct ShadowScore {
  int free = 0;    // frames in which its shadow ends on level ground inside the range gate
  int found = 0;   // of these
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
  ShadowScore buildings;  // other obstacles found where a building stands; free is not known
  int woods = 0;          // found where the ground or a wood drops by 3 m or more
  int false_alarms = 0;
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
        scene_.world.surfaces->intersect(antenna_.position_m, glm::normalize(path), 2.0e4);
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

  // Highest building over the ground, and largest drop of the surface, about an obstacle's edge.
  struct Surroundings {
    double building_m = 0.0, drop_m = 0.0;
  };
  Surroundings around(const sensors::ShadowObstacle& obstacle) const {
    Surroundings found;
    for (int column = obstacle.first_column - 1; column <= obstacle.last_column + 1; ++column) {
      double highest_m = -1e9, lowest_m = 1e9;
      const std::size_t k = static_cast<std::size_t>(
          std::clamp(column, obstacle.first_column, obstacle.last_column) - obstacle.first_column);
      const double edge_m = obstacle.column_range_m[k];
      for (double range_m = edge_m - 14.0; range_m <= edge_m + 140.0; range_m += 3.0) {
        const glm::dvec2 at = on_ground(column, range_m);
        const auto hit =
            scene_.world.surfaces->intersect(glm::dvec3(at, 2000.0), {0.0, 0.0, -1.0}, 5000.0);
        if (!hit) continue;
        const double top_m = 2000.0 - hit->distance_m;
        if (range_m <= edge_m + 80.0) {
          highest_m = std::max(highest_m, top_m);
          found.building_m = std::max(found.building_m, top_m - ground_m(at));
        }
        if (range_m >= edge_m) lowest_m = std::min(lowest_m, top_m);
      }
      found.drop_m = std::max(found.drop_m, highest_m - lowest_m);
    }
    return found;
  }

 private:
  double ground_m(glm::dvec2 at) const {
    return scene_.world.surfaces->terrain()->height_at(at.x, at.y).value_or(0.0);
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
  glm::dvec2 on_ground(int column, double range_m) const {
    const sensors::Scan& scan = scene_.world.sensor.scan;
    const glm::dvec3 ahead =
        sensors::direction(antenna_, sensors::column_middle_rad(scan, column), 0.0, scan.surface);
    const double distance_m = std::sqrt(std::max(range_m * range_m - height_m_ * height_m_, 0.0));
    return glm::dvec2(antenna_.position_m) + glm::normalize(glm::dvec2(ahead)) * distance_m;
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
      const auto best = std::max_element(
          at, left.end(), [](const auto& a, const auto& b) { return a.height_m < b.height_m; });
      if (free && best != left.end())
        score(best->height_m, box.height_m, best->height_error_m, of_box);
      left.erase(at, left.end());
    }
    for (const sensors::ShadowObstacle& obstacle : left) {
      const ShadowTruth::Surroundings there = truth.around(obstacle);
      if (there.building_m > 2.0)
        score(obstacle.height_m, there.building_m, obstacle.height_error_m, tally.buildings);
      else if (there.drop_m >= 3.0)
        ++tally.woods;
      else
        ++tally.false_alarms;
    }
  }
  return tally;
}

}  // namespace fanbeam::tests
