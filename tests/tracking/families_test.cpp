// Three families of traffic, drawn at random: cars side by side, cars that brake while nobody sees them for a
// while, stop-and-go beside an overtaker.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "core/random_normals.h"
#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"
#include "tracking/filters/chi_square.h"
#include "tracking/simulation/sampled_frame.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

struct Score {
  double mota = 0.0;
  int runs = 0, without_switch = 0;
  MeanSquare nees;  // as its own value
  double worst_mota = 1.0;
};

double uniform(int run, std::uint64_t what, double low, double high) {
  // Of a normal number its distribution: uniform.
  const double n = core::normal_pair(run_key(run, 2525), what, 0)[0];
  return low + (high - low) * 0.5 * std::erfc(-n / std::sqrt(2.0));
}

Score score_of(const std::function<core::HighwayScenario(int)>& draw, int runs,
               bool from_samples = false) {
  Score score;
  for (int run = 0; run < runs; ++run) {
    const core::HighwayScenario scenario = draw(run);
    const core::HighwayRadar radar = highway_radar();
    ScenarioScore one;
    const SampledRadar sampled(radar);
    const auto number = static_cast<std::uint32_t>(run);
    run_scenario(
        scenario, radar, road_tracker(radar, scenario.radar_speed_mps),
        [&](int frame) {
          return from_samples ? sampled.measure(scenario, 77, number, frame)
                              : simulated_frame(scenario, radar, {}, 77, number, frame);
        },
        [&](const Frame& frame) {
          one.add(scenario, frame);
          for (const auto& [target, id] : one.mot.current_match())
            for (const Track& track : frame.tracker->tracks())
              if (track.id == id && frame.time_s > 0.3)
                score.nees.add(nees_of(track, frame.motion[static_cast<std::size_t>(target)]));
        });
    score.mota += one.mot.mota() / runs;
    score.worst_mota = std::min(score.worst_mota, one.mot.mota());
    score.without_switch += one.mot.switches() == 0 ? 1 : 0;
    ++score.runs;
  }
  return score;
}

// Farther apart than 1.2 cells of range (0.72 m) all the time.
core::HighwayScenario side_by_side(int run) {
  const double range_m = uniform(run, 1, 30.0, 80.0);
  const double speed_mps = kRoadSpeed_mps + uniform(run, 2, -1.0, 1.0);
  const double apart_mps = uniform(run, 3, 0.0, 0.5),
               ahead = uniform(run, 5, -1.0, 1.0) > 0.0 ? 1.0 : -1.0;
  return scene(
      6.0, kRoadSpeed_mps,
      {car("A", range_m, -1.5, speed_mps),
       car("B", range_m + ahead * uniform(run, 4, 0.8, 1.8), 1.5, speed_mps + ahead * apart_mps)});
}

// Meeting, within a cell for a while, and parting again, or not yet.
core::HighwayScenario overtaking(int run) {
  const double range_m = uniform(run, 1, 30.0, 80.0);
  const double speed_mps = kRoadSpeed_mps + uniform(run, 2, -1.0, 1.0);
  const double meeting_mps = uniform(run, 3, 0.3, 0.5);
  return scene(12.0, kRoadSpeed_mps,
               {car("A", range_m, -1.5, speed_mps),
                car("B", range_m - uniform(run, 4, 1.2, 2.0), 1.5, speed_mps + meeting_mps)});
}

core::HighwayScenario braking(int run) {
  core::HighwayTarget other = car("A", uniform(run, 1, 40.0, 60.0), -3.7, kRoadSpeed_mps + 1.0);
  core::HighwayTarget target = car("B", uniform(run, 2, 90.0, 130.0), 0.0, kRoadSpeed_mps);
  const double from_s = uniform(run, 3, 0.8, 1.5);
  target.accelerations = {{from_s, from_s + 2.0, {-6.0, 0.0}}};
  const double gap_s = uniform(run, 4, 0.6, from_s + 2.0);
  target.suppressed = {{gap_s, gap_s + 0.6}};
  return scene(4.5, kRoadSpeed_mps, {other, target});
}

core::HighwayScenario stop_and_go(int run) {
  core::HighwayTarget jam = car("A", uniform(run, 1, 30.0, 60.0), 0.0, uniform(run, 2, 8.0, 15.0));
  const double stop_s = uniform(run, 3, 0.5, 1.5);
  const double braking_mps2 = uniform(run, 4, 2.0, 5.0);
  const double stopped_s = stop_s + jam.velocity_mps[0] / braking_mps2;
  const double go_s = stopped_s + uniform(run, 5, 0.5, 1.5);
  jam.accelerations = {{stop_s, stopped_s, {-braking_mps2, 0.0}}, {go_s, go_s + 3.0, {3.0, 0.0}}};
  core::HighwayTarget overtaker = car("B", uniform(run, 6, 10.0, 20.0), -3.7, 15.0);
  return scene(10.0, 3.0, {jam, overtaker});
}

// By 3.7 m within 2.4 to 4 s, behind another car.
core::HighwayScenario lane_change(int run) {
  const double from_s = uniform(run, 1, 0.5, 1.5), half_s = uniform(run, 2, 1.2, 2.0);
  const double across_mps2 = 3.7 / (half_s * half_s);
  core::HighwayTarget target =
      car("A", uniform(run, 3, 30.0, 80.0), 0.0, kRoadSpeed_mps + uniform(run, 4, -3.0, 3.0));
  target.accelerations = {{from_s, from_s + half_s, {0.0, across_mps2}},
                          {from_s + half_s, from_s + 2.0 * half_s, {0.0, -across_mps2}}};
  const core::HighwayTarget ahead =
      car("B", target.position_m[0] + uniform(run, 5, 10.0, 30.0), 0.0, kRoadSpeed_mps + 1.0);
  return scene(7.0, kRoadSpeed_mps, {target, ahead});
}

// As the tracker expects: 0.5 m/s2 along and across, another one in each scan.
core::HighwayScenario wandering(int run) {
  std::vector<core::HighwayTarget> cars = {
      car("A", uniform(run, 1, 30.0, 60.0), -3.7, kRoadSpeed_mps + uniform(run, 2, -2.0, 2.0)),
      car("B", uniform(run, 3, 80.0, 120.0), 0.0, kRoadSpeed_mps + uniform(run, 4, -2.0, 2.0))};
  std::uint64_t draw = 100;
  for (core::HighwayTarget& one : cars)
    for (int scan = 0; scan < 120; ++scan) {
      const auto n = core::normal_pair(run_key(run, 2525), draw++, 0);
      one.accelerations.push_back(
          {scan * kStep_s, (scan + 1) * kStep_s, {kSteady_mps2 * n[0], kSteady_mps2 * n[1]}});
    }
  return scene(6.0, kRoadSpeed_mps, cars);
}

constexpr int kRuns = 100;

std::string words_of(const Score& score) {
  return "MOTA " + std::to_string(score.mota) + ", without a switch " +
         std::to_string(score.without_switch) + " of " + std::to_string(score.runs) + ", NEES " +
         std::to_string(score.nees.mean());
}

bool in_band(const Score& score) {
  const Interval band = mean_interval(4, kRuns);
  return score.nees.mean() >= band.low && score.nees.mean() <= band.high;
}

// Of four states; cars that drive straight on, which the tracker does not know, bring it somewhat below: their speed across the
// line of sight errs by 0.6 of what is told.
void check_honest(const Score& score) {
  const Interval band = mean_interval(4, kRuns);
  CHECK(score.nees.mean() <= band.high);
  CHECK(score.nees.mean() >= 3.0);
}

Score check_kept(core::HighwayScenario (*draw)(int)) {
  const Score score = score_of(draw, kRuns);
  INFO(words_of(score));
  CHECK(score.mota >= 0.97);
  CHECK(score.without_switch >= 95);
  return score;
}

}  // namespace

// With one model straight on and one for turns, braking cars had a MOTA of 0.77 and switched in every run,
// stop-and-go 0.27.
TEST_CASE("Cars side by side, that brake unseen for 0.6 s, or stop and go stay one track each",
          "[tracker][statistics]") {
  for (const auto draw : {side_by_side, braking, stop_and_go}) check_honest(check_kept(draw));
}

// Cars that do what the tracker expects, and cars that change lanes, whose turn begins and ends at once.
TEST_CASE("Tracks of cars that wander and that change lanes err by as much as they say",
          "[tracker][statistics]") {
  for (const auto draw : {wandering, lane_change, braking}) {
    const Score score = check_kept(draw);
    INFO(words_of(score));
    CHECK(in_band(score));
  }
}

// Within a cell of range for three to five seconds, where the radar sees one: they are told apart again by
// the lane that each was in. With the constant resolution that decided before, 80 of 100.
TEST_CASE("Cars that overtake slowly in the next lane keep their names", "[tracker][statistics]") {
  check_kept(overtaking);
}

// Six cars anywhere within 8 m/s. Where targets of one speed merged to a range between them MOTA was 0.44, with
// a false track in every scan; 0.958 and 0.17 where pairs of beats were taken by their speed alone. The three
// that are left are of two cars beside each other that merge in range, speed and direction.
TEST_CASE("A coded stretch follows six cars of like speeds", "[tracker][statistics]") {
  SimulationSettings simulation;
  simulation.scheme = Scheme::coded;
  constexpr int kSixes = 20;
  double mota = 0.0, false_tracks = 0.0, scans = 0.0;
  for (int run = 0; run < kSixes; ++run) {
    std::vector<core::HighwayTarget> cars;
    for (std::uint64_t i = 0; i < 6; ++i)
      cars.push_back(car(std::array{"A", "B", "C", "D", "E", "F"}[i],
                         uniform(run, 10 + i, 15.0, 150.0),
                         std::floor(uniform(run, 30 + i, -1.5, 2.5)) * 3.7 - 1.8,
                         kRoadSpeed_mps + uniform(run, 50 + i, -8.0, 8.0)));
    const core::HighwayRadar radar = highway_radar();
    const core::HighwayScenario scenario = scene(6.0, kRoadSpeed_mps, cars);
    ScenarioScore one;
    run_scenario(scenario, radar, simulation, road_tracker(radar, scenario.radar_speed_mps), 77,
                 static_cast<std::uint32_t>(run), [&](const Frame& frame) {
                   one.add(scenario, frame);
                   ++scans;
                 });
    mota += one.mot.mota() / kSixes;
    false_tracks += one.mot.false_tracks();
  }
  INFO("MOTA " << mota << ", false tracks a scan " << false_tracks / scans);
  CHECK(mota >= 0.98);
  CHECK(false_tracks / scans <= 0.005);
}

// A hundred runs each take minutes: side by side MOTA 0.990 and overtaking 0.995, no switch, by 40 and 20 of
// them (0.941 and 0.65 before two tones were sought in a peak and directions taken from the triangle).
TEST_CASE("From samples, cars side by side and overtaking keep their names",
          "[sampled][statistics]") {
  for (const auto& [draw, runs] : {std::pair{&side_by_side, 6}, {&overtaking, 3}}) {
    const Score score = score_of(draw, runs, true);
    INFO(words_of(score));
    CHECK(score.mota >= 0.97);
    CHECK(score.without_switch == runs);
  }
}

// A post in one cell with the car, apart by an angle that the samples tell.
TEST_CASE("From samples, a car on a ring road is not taken for the post beside it",
          "[sampled][statistics]") {
  const Score score = score_of([](int) { return beaming(); }, 2, true);
  INFO(words_of(score));
  CHECK(score.mota >= 0.97);
  CHECK(score.without_switch == 2);
}

TEST_CASE("Tracks of S1 to S3 are as good as they say in all four states",
          "[tracker][statistics]") {
  for (const core::HighwayScenario& scenario :
       {one_stopped_car(), six_vehicles(), slow_crossing()}) {
    const Score score = score_of([&](int) { return scenario; }, 30);
    INFO(words_of(score));
    check_honest(score);
  }
}
