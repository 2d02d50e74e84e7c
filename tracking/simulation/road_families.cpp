#include "tracking/simulation/road_families.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace fanbeam::tracking {
namespace {

core::RandomKey key_of(int run) { return {20251121, 2525, static_cast<std::uint32_t>(run)}; }

// Farther apart than 1.2 cells of range (0.72 m) all the time.
core::HighwayScenario side_by_side(int run, double) {
  const double range_m = road_uniform(run, 1, 30.0, 80.0);
  const double speed_mps = kRoadSpeed_mps + road_uniform(run, 2, -1.0, 1.0);
  const double apart_mps = road_uniform(run, 3, 0.0, 0.5),
               ahead = road_uniform(run, 5, -1.0, 1.0) > 0.0 ? 1.0 : -1.0;
  return road_scene(6.0, kRoadSpeed_mps,
                    {road_car("A", range_m, -1.5, speed_mps),
                     road_car("B", range_m + ahead * road_uniform(run, 4, 0.8, 1.8), 1.5,
                              speed_mps + ahead * apart_mps)});
}

// Meeting, within a cell for a while, and parting again, or not yet.
core::HighwayScenario overtaking(int run, double) {
  const double range_m = road_uniform(run, 1, 30.0, 80.0);
  const double speed_mps = kRoadSpeed_mps + road_uniform(run, 2, -1.0, 1.0);
  const double meeting_mps = road_uniform(run, 3, 0.3, 0.5);
  return road_scene(
      12.0, kRoadSpeed_mps,
      {road_car("A", range_m, -1.5, speed_mps),
       road_car("B", range_m - road_uniform(run, 4, 1.2, 2.0), 1.5, speed_mps + meeting_mps)});
}

core::HighwayScenario braking(int run, double) {
  core::HighwayTarget other =
      road_car("A", road_uniform(run, 1, 40.0, 60.0), -3.7, kRoadSpeed_mps + 1.0);
  core::HighwayTarget target =
      road_car("B", road_uniform(run, 2, 90.0, 130.0), 0.0, kRoadSpeed_mps);
  const double from_s = road_uniform(run, 3, 0.8, 1.5);
  target.accelerations = {{from_s, from_s + 2.0, {-6.0, 0.0}}};
  const double gap_s = road_uniform(run, 4, 0.6, from_s + 2.0);
  target.suppressed = {{gap_s, gap_s + 0.6}};
  return road_scene(4.5, kRoadSpeed_mps, {other, target});
}

core::HighwayScenario stop_and_go(int run, double) {
  core::HighwayTarget jam =
      road_car("A", road_uniform(run, 1, 30.0, 60.0), 0.0, road_uniform(run, 2, 8.0, 15.0));
  const double stop_s = road_uniform(run, 3, 0.5, 1.5);
  const double braking_mps2 = road_uniform(run, 4, 2.0, 5.0);
  const double stopped_s = stop_s + jam.velocity_mps[0] / braking_mps2;
  const double go_s = stopped_s + road_uniform(run, 5, 0.5, 1.5);
  jam.accelerations = {{stop_s, stopped_s, {-braking_mps2, 0.0}}, {go_s, go_s + 3.0, {3.0, 0.0}}};
  core::HighwayTarget overtaker = road_car("B", road_uniform(run, 6, 10.0, 20.0), -3.7, 15.0);
  return road_scene(10.0, 3.0, {jam, overtaker});
}

// By 3.7 m within 2.4 to 4 s, behind another car.
core::HighwayScenario lane_change(int run, double) {
  const double from_s = road_uniform(run, 1, 0.5, 1.5), half_s = road_uniform(run, 2, 1.2, 2.0);
  const double across_mps2 = 3.7 / (half_s * half_s);
  core::HighwayTarget target = road_car("A", road_uniform(run, 3, 30.0, 80.0), 0.0,
                                        kRoadSpeed_mps + road_uniform(run, 4, -3.0, 3.0));
  target.accelerations = {{from_s, from_s + half_s, {0.0, across_mps2}},
                          {from_s + half_s, from_s + 2.0 * half_s, {0.0, -across_mps2}}};
  const core::HighwayTarget ahead = road_car(
      "B", target.position_m[0] + road_uniform(run, 5, 10.0, 30.0), 0.0, kRoadSpeed_mps + 1.0);
  return road_scene(7.0, kRoadSpeed_mps, {target, ahead});
}

// As the tracker expects: 0.5 m/s2 along and across, another one in each scan.
core::HighwayScenario wandering(int run, double frame_s) {
  constexpr double kLength_s = 6.0;
  const int scans = static_cast<int>(std::lround(std::min(kLength_s / frame_s, 1e6)));
  std::vector<core::HighwayTarget> cars = {
      road_car("A", road_uniform(run, 1, 30.0, 60.0), -3.7,
               kRoadSpeed_mps + road_uniform(run, 2, -2.0, 2.0)),
      road_car("B", road_uniform(run, 3, 80.0, 120.0), 0.0,
               kRoadSpeed_mps + road_uniform(run, 4, -2.0, 2.0))};
  std::uint64_t draw = 100;
  for (core::HighwayTarget& one : cars)
    for (int scan = 0; scan < scans; ++scan) {
      const auto n = core::normal_pair(key_of(run), draw++, 0);
      one.accelerations.push_back(
          {scan * frame_s, (scan + 1) * frame_s, {kSteady_mps2 * n[0], kSteady_mps2 * n[1]}});
    }
  return road_scene(kLength_s, kRoadSpeed_mps, cars);
}

constexpr RoadFamily kFamilies[] = {{"side by side", side_by_side}, {"braking", braking},
                                    {"stop and go", stop_and_go},   {"lane change", lane_change},
                                    {"wandering", wandering},       {"overtaking", overtaking}};

// Until a track has settled.
constexpr double kFrom_s = 0.3;

void add_nees(const ScenarioFrame& frame, const ClearMot& mot, MeanSquare& nees) {
  for (const auto& [target, id] : mot.current_match())
    for (const Track& track : frame.tracker->tracks())
      if (track.id == id && frame.time_s > kFrom_s)
        nees.add(nees_of(track, frame.motion[static_cast<std::size_t>(target)]));
}

}  // namespace

// Of a normal number its distribution: uniform.
double road_uniform(int run, std::uint64_t what, double low, double high) {
  const double n = core::normal_pair(key_of(run), what, 0)[0];
  return low + (high - low) * 0.5 * std::erfc(-n / std::sqrt(2.0));
}

core::HighwayTarget road_car(const char* id, double x_m, double y_m, double vx_mps) {
  core::HighwayTarget target;
  target.id = id;
  target.cross_section_m2 = 10.0;
  target.position_m = {x_m, y_m};
  target.velocity_mps = {vx_mps, 0.0};
  return target;
}

core::HighwayScenario road_scene(double duration_s, double radar_speed_mps,
                                 std::vector<core::HighwayTarget> targets) {
  core::HighwayScenario result;
  result.duration_s = duration_s;
  result.radar_speed_mps = radar_speed_mps;
  result.targets = std::move(targets);
  return result;
}

std::span<const RoadFamily> road_families() { return kFamilies; }

double FamilyScore::mota() const {
  double sum = 0.0;
  for (const FamilyRun& run : runs) sum += run.mota / static_cast<double>(runs.size());
  return sum;
}

double FamilyScore::worst_mota() const {
  double worst = 1.0;
  for (const FamilyRun& run : runs) worst = std::min(worst, run.mota);
  return worst;
}

int FamilyScore::without_switch() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.switches == 0; }));
}

FamilyScore score_family(const RoadFamily& family, int runs, const core::HighwayRadar& radar,
                         const SettingsOf& settings, const MeasureRun& measure) {
  FamilyScore score;
  score.runs.resize(static_cast<std::size_t>(runs));
  std::vector<MeanSquare> nees(score.runs.size());
  core::parallel_for(score.runs.size(), [&](std::size_t i) {
    const int run = static_cast<int>(i);
    const core::HighwayScenario scenario = family.draw(run, radar.frame_s);
    ScenarioScore one;
    run_scenario(
        scenario, radar, settings(scenario),
        [&](int frame) { return measure(scenario, static_cast<std::uint32_t>(run), frame); },
        [&](const ScenarioFrame& frame) {
          one.add(scenario, frame);
          add_nees(frame, one.mot, nees[i]);
        });
    score.runs[i] = {one.mot.mota(), one.mot.switches(), {}};
    if (nees[i].count() > 0) score.runs[i].nees = nees[i].mean();
  });
  for (const MeanSquare& one : nees) score.nees.add(one);
  return score;
}

}  // namespace fanbeam::tracking
