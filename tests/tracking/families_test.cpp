// Families of traffic, drawn at random (tracking/simulation/road_families.h), and the four scenarios: who is who,
// and how true told errors are.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"
#include "tracking/filters/chi_square.h"
#include "tracking/simulation/road_families.h"
#include "tracking/simulation/sampled_frame.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

constexpr int kRuns = 100;

FamilyScore score_of(const RoadFamily& family, int runs, bool from_samples = false,
                     const SimulationSettings& simulation = {}) {
  const core::HighwayRadar radar = highway_radar();
  const SampledRadar sampled(radar);
  return score_family(
      family, runs, radar,
      [&](const auto& scenario) { return road_tracker(radar, scenario.radar_speed_mps); },
      [&](const auto& scenario, std::uint32_t run, int frame) {
        return from_samples ? sampled.measure(scenario, 77, run, frame)
                            : simulated_frame(scenario, radar, simulation, 77, run, frame);
      });
}

FamilyScore score_of(const std::string& name, int runs, bool from_samples = false) {
  const auto family = std::find_if(road_families().begin(), road_families().end(),
                                   [&](const RoadFamily& one) { return one.name == name; });
  REQUIRE(family != road_families().end());
  return score_of(*family, runs, from_samples);
}

std::string words_of(const FamilyScore& score) {
  return "MOTA " + std::to_string(score.mota()) + ", without a switch " +
         std::to_string(score.without_switch()) + " of " + std::to_string(score.runs.size()) +
         ", NEES " + std::to_string(score.nees.mean());
}

bool in_band(const FamilyScore& score) {
  const Interval band = mean_interval(4, static_cast<int>(score.runs.size()));
  return score.nees.mean() >= band.low && score.nees.mean() <= band.high;
}

void check_kept(const std::string& name) {
  const FamilyScore score = score_of(name, kRuns);
  INFO(name << ": " << words_of(score));
  CHECK(score.mota() >= 0.97);
  CHECK(score.without_switch() >= 95);
  CHECK(in_band(score));
}

}  // namespace

// With one model straight on and one for turns, braking cars had a MOTA of 0.77 and switched in every run, stop-and-go
// 0.27. With turns of white acceleration across, cars that drive straight on had a NEES of 3.3.
TEST_CASE(
    "Cars side by side, that brake unseen for 0.6 s, or stop and go stay one track each, as true "
    "as told",
    "[tracker][statistics]") {
  for (const char* name : {"side by side", "braking", "stop and go"}) check_kept(name);
}

// Cars that do what the tracker expects, and cars that change lanes, whose turn begins and ends at once.
TEST_CASE("Tracks of cars that wander and that change lanes err by as much as they say",
          "[tracker][statistics]") {
  for (const char* name : {"wandering", "lane change"}) check_kept(name);
}

// Within a cell of range for three to five seconds, where the radar sees one: they are told apart again by
// the lane that each was in. With the constant resolution that decided before, 80 of 100.
TEST_CASE("Cars that overtake slowly in the next lane keep their names", "[tracker][statistics]") {
  check_kept("overtaking");
}

// While a pair is one its predictions drift apart; a track began on the one echo between them, and kept the pair from parting
// when there were two again: a switch, and a MOTA of 0.88. That track counts as a false one for a while, 0.965.
TEST_CASE("A track that begins on a pair's one echo does not keep the pair from parting",
          "[tracker]") {
  const auto overtaking =
      std::find_if(road_families().begin(), road_families().end(),
                   [](const RoadFamily& one) { return std::string(one.name) == "overtaking"; });
  const core::HighwayRadar radar = highway_radar();
  for (const auto& [seed, run] : {std::pair(0, 7), std::pair(79, 73)}) {
    CAPTURE(seed, run);
    const core::HighwayScenario scenario = overtaking->draw(run, radar.frame_s);
    ScenarioScore score;
    run_scenario(scenario, radar, {}, road_tracker(radar, scenario.radar_speed_mps),
                 static_cast<std::uint64_t>(seed), static_cast<std::uint32_t>(run),
                 [&](const Frame& frame) { score.add(scenario, frame); });
    CHECK(score.mot.switches() == 0);
    CHECK(score.mot.mota() > 0.96);
  }
}

// Of any speeds, near and far, and past the radar by half a metre at least: 4 cm before it, where two came through it, a
// point's bound is below what linearising leaves. Where far cars were told the errors of near ones that their coarse place
// was merged of, the mean NEES of these was 90 250.
core::HighwayScenario six_of_any_speed(int run, double) {
  std::vector<core::HighwayTarget> cars;
  for (std::uint64_t i = 0; i < 6; ++i)
    cars.push_back(road_car(std::array{"A", "B", "C", "D", "E", "F"}[i],
                            road_uniform(run, 10 + i, 15.0, 150.0),
                            std::floor(road_uniform(run, 30 + i, -1.0, 2.0)) * 3.7 + 0.5,
                            kRoadSpeed_mps + road_uniform(run, 50 + i, -30.0, 30.0)));
  return road_scene(3.0, kRoadSpeed_mps, cars);
}
TEST_CASE("A coded stretch tells each car's own errors", "[tracker][statistics]") {
  SimulationSettings simulation;
  simulation.scheme = Scheme::coded;
  const FamilyScore score = score_of(RoadFamily{"six", six_of_any_speed}, kRuns, false, simulation);
  INFO(words_of(score));
  CHECK(score.nees.mean() <= mean_interval(4, kRuns).high);
  for (const FamilyRun& one : score.runs) CHECK(one.nees.value_or(0.0) < 20.0);
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
                         road_uniform(run, 10 + i, 15.0, 150.0),
                         std::floor(road_uniform(run, 30 + i, -1.5, 2.5)) * 3.7 - 1.8,
                         kRoadSpeed_mps + road_uniform(run, 50 + i, -8.0, 8.0)));
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

// A hundred draws each take minutes (docs/tracking.md). Before two tones were sought in a peak and directions taken from the
// triangle MOTA was 0.941, NEES 0.65.
TEST_CASE("From samples, the families keep their names", "[sampled][statistics]") {
  for (const auto& [name, runs] :
       {std::pair{"side by side", 6}, {"braking", 3}, {"stop and go", 2}, {"overtaking", 3}}) {
    const FamilyScore score = score_of(name, runs, true);
    INFO(name << ": " << words_of(score));
    CHECK(score.mota() >= 0.97);
    CHECK(score.without_switch() == runs);
    CHECK(score.nees.mean() <= mean_interval(4, runs).high);
    CHECK(score.nees.mean() >=
          2.0);  // 0.5 where every measurement told 5 mm for what processing leaves
  }
}

// Two points in one lane, more than 1.2 cells of speed apart, of which one comes past the other: four pairs of beats and
// one direction, so that it does not tell which belong together. MOTA 0.12, NEES 289, with crossed pairs confirmed as
// cars, where each tone of a shared peak took the beat whose direction was nearest.
core::HighwayScenario in_one_lane(int run, double) {
  const double range_m = road_uniform(run, 1, 35.0, 75.0);
  const double faster_mps = road_uniform(run, 2, 1.25, 2.5);
  return road_scene(2.0, kRoadSpeed_mps,
                    {road_car("A", range_m, 0.0, kRoadSpeed_mps),
                     road_car("B", range_m - faster_mps * road_uniform(run, 3, 0.6, 1.4),
                              road_uniform(run, 4, -0.3, 0.3), kRoadSpeed_mps + faster_mps)});
}
TEST_CASE("From samples, two in one lane are told apart by their speeds, without crossed pairs",
          "[sampled][statistics]") {
  const FamilyScore score = score_of(RoadFamily{"in one lane", in_one_lane}, 8, true);
  INFO(words_of(score));
  CHECK(score.mota() >= 0.95);
  CHECK(score.worst_mota() >= 0.92);
  CHECK(score.without_switch() == 8);
  CHECK(score.nees.mean() <=
        mean_interval(4, 8).high);  // 130 where a shared beat's direction was one car's
}

// A post in one cell with the car, apart by an angle that the samples tell.
TEST_CASE("From samples, a car on a ring road is not taken for the post beside it",
          "[sampled][statistics]") {
  const FamilyScore score =
      score_of(RoadFamily{"S4", [](int, double) { return beaming(); }}, 2, true);
  INFO(words_of(score));
  // 0.982 and 1.02 where range and speed were of both for as long as they shared them.
  CHECK(score.mota() >= 0.985);
  CHECK(score.without_switch() == 2);
  CHECK(score.nees.mean() >= mean_interval(4, 2).low);
}

// S4, a car on a ring around the radar and a post of the same range: within a sixth of c / (N d) of it, for a fifth of a
// second, the two are one measurement and their tracks coast. With white acceleration along the way and beats that merged
// within a beam 2.69.
TEST_CASE("Tracks of S1 to S4 are as good as they say in all four states",
          "[tracker][statistics]") {
  for (const RoadFamily& scenario :
       {RoadFamily{"S1", [](int, double) { return one_stopped_car(); }},
        RoadFamily{"S2", [](int, double) { return six_vehicles(); }},
        RoadFamily{"S3", [](int, double) { return slow_crossing(); }},
        RoadFamily{"S4", [](int, double) { return beaming(); }}}) {
    const FamilyScore score = score_of(scenario, kRuns);
    INFO(scenario.name << ": " << words_of(score));
    CHECK(score.mota() >= 0.98);
    CHECK(in_band(score));
  }
}
