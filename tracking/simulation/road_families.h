// Families of traffic on a road, each drawn at random, and how a tracker does on them: what the tracker
// was made for, beyond the scenarios that it was tried on first.
//
//   side by side    3 m beside each other, 0.8 to 1.8 m apart in range (more than 1.2 cells of 0.6 m),
//                   30 to 80 m away, speeds within 0.5 m/s
//   braking         at 6 m/s2 for 2 s, not measured for 0.6 s, beside another car
//   stop and go     8 to 15 m/s to 0 and on, beside a car that overtakes
//   lane change     by 3.7 m within 2.4 to 4 s, behind another car
//   wandering       0.5 m/s2 along and across, another one in each scan: what the tracker expects
//   overtaking      at 0.3 to 0.5 m/s in the next lane, within a cell of range for 3 to 5 s
//
// Cross-sections of 10 m2, the radar at 100 km/h (3 m/s where traffic stops). Draw `run` is a function of
// its number.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/highway.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::tracking {

inline constexpr double kRoadSpeed_mps = 100.0 / 3.6;

core::HighwayTarget road_car(const char* id, double x_m, double y_m, double vx_mps);
core::HighwayScenario road_scene(double duration_s, double radar_speed_mps,
                                 std::vector<core::HighwayTarget> targets);
// Draw `what` of a run.
double road_uniform(int run, std::uint64_t what, double low, double high);

struct RoadFamily {
  const char* name;
  core::HighwayScenario (*draw)(int run, double frame_s);
};
// In the order above.
std::span<const RoadFamily> road_families();

struct FamilyRun {
  double mota = 0.0;
  int switches = 0;
  // Normalised error squared of position and velocity, mean over what is matched from 0.3 s on: 4 on
  // average where a filter is as good as it says, 2 for a radar without azimuth. Absent where nothing is
  // matched.
  std::optional<double> nees;
};
struct FamilyScore {
  std::vector<FamilyRun> runs;
  MeanSquare nees;  // of all frames of all runs

  double mota() const;
  double worst_mota() const;
  int without_switch() const;
};

using MeasureRun = std::function<std::vector<RadarMeasurement>(
    const core::HighwayScenario& scenario, std::uint32_t run, int frame)>;
using SettingsOf = std::function<TrackerSettings(const core::HighwayScenario& scenario)>;

// Runs side by side: `settings` and `measure` are called from several threads at once. The same bits for any number of
// them.
FamilyScore score_family(const RoadFamily& family, int runs, const core::HighwayRadar& radar,
                         const SettingsOf& settings, const MeasureRun& measure);

}  // namespace fanbeam::tracking
