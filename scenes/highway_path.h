// Targets of a scene that move by the laws of a highway scenario (scenes/highway_reader.h).
//
// A [[target]] with `highway = { file, scenario, target }` stands for one scatterer of a car: `at`
// is where the scenario's origin lies for it, a place on a runway, so that scatterers of one car
// differ in `at` alone. x of the scenario counts along the runway's landing direction, y to its
// left. The scatterer's cross-section is that of the scene.
// The path is one of straight legs, from 1 s before the scenario begins to 1 s after it ends:
// legs of 1 ms, each about a whole millisecond, while the target accelerates, else a single one.
// Accuracy at whole milliseconds: a dt^2 / 8 in place (1e-6 m up to 8 m/s2), and 1e-6 m/s in speed,
// but where an acceleration begins or ends (a dt / 8); between them a dt / 2 in speed.
// Neglected: the scenario's own radar, whose path is the scene's trajectory; heights.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "core/config_table.h"
#include "scenes/data_search.h"
#include "scenes/description.h"
#include "scenes/highway_reader.h"
#include "scenes/waypoint_budget.h"

namespace fanbeam::scenes {

// Times of the waypoints of one target, increasing. E-LIMIT for more than 200 000.
std::vector<double> highway_times_s(const core::HighwayTarget& target, double duration_s);

// Reads each file once.
class HighwayPaths {
 public:
  explicit HighwayPaths(const DataSearch& search) : search_(&search) {}

  // The path of the target that the table `highway` of `target` names, about `origin`. Reports what
  // the reader of scenarios refuses; E-REF for an unknown scenario or target, or a place that is
  // not on a runway; E-LIMIT, and no path, once `budget` is spent.
  std::vector<TargetDescription::Waypoint> path(core::ConfigTable& target, const Spot& origin,
                                                double above_ground_m, WaypointBudget& budget);

  std::vector<std::filesystem::path> files() const;

 private:
  const HighwayFile* file_of(core::ConfigTable& table);

  const DataSearch* search_;
  std::map<std::filesystem::path, HighwayFile> files_;
};

}  // namespace fanbeam::scenes
