// The radar without an array: range and range rate alone, where identity is kept by speed.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

core::HighwayRadar lone_receiver() {
  core::HighwayRadar radar = highway_radar();
  radar.array_elements = 1;
  return radar;
}

TrackerSettings settings_of(double acceleration_mps2) {
  TrackerSettings settings = road_tracker(lone_receiver(), kRoadSpeed_mps);
  settings.motion.motions.resize(1);
  settings.motion.motions[0].acceleration_mps2 = acceleration_mps2;
  return settings;
}

struct Outcome {
  bool kept = false, crossed = false;
  double swap = 0.0;
};

// Two cars 3 m apart that close in at 3 km/h, each with white acceleration of the model's strength;
// closer than the resolution they are one measurement.
Outcome cross(double acceleration_mps2, int run) {
  Tracker tracker(settings_of(acceleration_mps2));
  double range_m[2] = {60.0, 63.0}, rate_mps[2] = {1.5 / 3.6, -1.5 / 3.6};
  constexpr double kSigma = 0.01;
  std::map<int, int> before;  // car of each track
  Outcome outcome;
  for (int frame = 0; frame < 240 && !outcome.crossed; ++frame) {
    std::vector<RadarMeasurement> measured;
    for (std::size_t car = 0; car < 2; ++car) {
      const auto key = run_key(run, 1010 + static_cast<std::uint32_t>(car));
      const auto cell = static_cast<std::uint64_t>(frame);
      const double a = acceleration_mps2 * core::normal_pair(key, cell, 0)[0];
      range_m[car] += rate_mps[car] * kStep_s + 0.5 * a * kStep_s * kStep_s;
      rate_mps[car] += a * kStep_s;
      const auto noise = core::normal_pair(key, cell, 1);
      measured.push_back(seen(range_m[car] + kSigma * noise[0], rate_mps[car] + kSigma * noise[1],
                              kSigma, kSigma));
    }
    const Resolution resolution;
    if (unresolved({range_m[0], rate_mps[0], 0.0}, {range_m[1], rate_mps[1], 0.0}, resolution)) {
      measured[0].range_m = 0.5 * (measured[0].range_m + measured[1].range_m);
      measured[0].range_rate_mps = 0.5 * (measured[0].range_rate_mps + measured[1].range_rate_mps);
      measured.pop_back();
    }
    tracker.update(frame * kStep_s, measured);
    const auto nearest = [&](const Track& track) {
      const double r = polar(track.state).range_m;
      return std::abs(r - range_m[0]) < std::abs(r - range_m[1]) ? 0 : 1;
    };
    if (frame == 10)
      for (const Track& track : tracker.tracks()) before[track.id] = nearest(track);
    if (tracker.crossings().empty()) continue;
    // Given up: half and half, and which goes on is not yet seen.
    if (tracker.crossings()[0].given_up) return {};
    outcome.crossed = true;
    outcome.swap = tracker.crossings()[0].swap_probability;
    outcome.kept = true;
    for (const Track& track : tracker.tracks())
      if (before.count(track.id) != 0 && before[track.id] != nearest(track)) outcome.kept = false;
  }
  return outcome;
}

}  // namespace

TEST_CASE("Without azimuth, swaps after a crossing happen as often as the tracker says",
          "[crossing][statistics]") {
  for (const double acceleration_mps2 : {0.25, 0.5, 1.0}) {
    int crossed = 0, swapped = 0;
    double told = 0.0, brier = 0.0;
    for (int run = 0; run < 1000; ++run) {
      const Outcome one = cross(acceleration_mps2, run);
      if (!one.crossed) continue;
      ++crossed;
      swapped += !one.kept;
      told += one.swap;
      brier += std::pow(one.swap - (one.kept ? 0.0 : 1.0), 2);
    }
    INFO("acceleration " << acceleration_mps2 << ": " << swapped << " of " << crossed
                         << " swapped, told " << told / crossed << ", Brier " << brier / crossed);
    CHECK(crossed >= 500);
    CHECK(told / crossed ==
          Approx(static_cast<double>(swapped) / crossed).epsilon(0.0).margin(0.03));
  }
}

TEST_CASE("S3 without azimuth: identity is kept by speed in 99 of 100, and said so",
          "[tracker][statistics]") {
  constexpr int kRuns = 200;
  int kept = 0;
  double brier = 0.0;
  MeanSquare range_rms;
  double largest_m = 0.0;
  const core::HighwayScenario scenario = slow_crossing();
  const TrackerSettings settings = road_tracker(lone_receiver(), kRoadSpeed_mps);
  for (int run = 0; run < kRuns; ++run) {
    ScenarioScore score;
    std::map<int, int> first;
    double identity = 1.0;
    std::size_t crossings = 0;
    run_scenario(scenario, lone_receiver(), {}, settings, 20251121, static_cast<std::uint32_t>(run),
                 [&](const Frame& frame) {
                   score.add(scenario, frame);
                   if (frame.time_s > 1.0 && first.empty()) first = score.mot.last_match();
                   for (const Track& track : frame.tracker->tracks())
                     if (track.confirmed) identity = std::min(identity, track.identity_probability);
                   crossings = frame.tracker->crossings().size();
                 });
    const bool same = score.mot.last_match() == first && score.tracks.size() == 2;
    CHECK(crossings == 1);
    kept += same;
    range_rms.add(score.range_m.rms());
    largest_m = std::max(largest_m, score.range_m.largest());
    brier += std::pow(identity - (same ? 1.0 : 0.0), 2) / kRuns;
  }
  INFO("S3 without azimuth: kept " << kept << ", Brier " << brier << ", range " << range_rms.rms()
                                   << " m, largest " << largest_m << " m");
  CHECK(kept >= 0.99 * kRuns);
  CHECK(brier <= 0.02);
  CHECK(range_rms.rms() <= 0.1);
  CHECK(largest_m <= 1.0);
}
