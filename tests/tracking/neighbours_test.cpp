// Two targets close together: each gets a track, and where the radar cannot tell two from one it says so.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"
#include "tracking/simulation/directions.h"
#include "tracking/simulation/sampled_frame.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

core::HighwayScenario beside(double range_m, double apart_m, double late_s) {
  core::HighwayTarget neighbour =
      car("B", std::sqrt(std::pow(range_m + apart_m, 2) - 9.0), -3.0, kRoadSpeed_mps);
  if (late_s > 0.0) neighbour.suppressed = {{0.0, late_s}};
  return scene(3.0, kRoadSpeed_mps, {car("A", range_m, 0.0, kRoadSpeed_mps), neighbour});
}

struct Followed {
  ScenarioScore score;
  std::size_t at_end = 0;
  double two_from_s = -1.0;  // when two tracks were confirmed first
  int coasted =
      0;  // the most frames that a confirmed track was not measured in, one after the other
  MeanSquare nees;
};

Followed follow(const core::HighwayScenario& scenario, const SampledRadar* sampled = nullptr) {
  const core::HighwayRadar radar = highway_radar();
  Followed result;
  run_scenario(
      scenario, radar, road_tracker(radar, scenario.radar_speed_mps),
      [&](int frame) {
        return sampled != nullptr ? sampled->measure(scenario, 5, 0, frame)
                                  : simulated_frame(scenario, radar, {}, 5, 0, frame);
      },
      [&](const Frame& frame) {
        result.score.add(scenario, frame);
        result.at_end = frame.confirmed().size();
        if (result.at_end == 2 && result.two_from_s < 0.0) result.two_from_s = frame.time_s;
        for (const Track& track : frame.tracker->tracks())
          if (track.confirmed) result.coasted = std::max(result.coasted, track.coasted);
        for (const auto& [target, id] : result.score.mot.current_match())
          for (const Track& track : frame.tracker->tracks())
            if (track.id == id)
              result.nees.add(nees_of(track, frame.motion[static_cast<std::size_t>(target)]));
      });
  return result;
}

}  // namespace

// Where measurements near a confirmed track started none, it never had one: MOTA 0.5.
TEST_CASE("A neighbour that is first seen late has a track from then on", "[tracker]") {
  for (const double apart_m : {0.9, 1.0, 1.1, 1.25}) {
    const Followed followed = follow(beside(40.0, apart_m, 0.5));
    INFO(apart_m);
    CHECK(followed.at_end == 2);
    CHECK(followed.two_from_s >= 0.5);
    CHECK(followed.two_from_s < 0.75);
    CHECK(followed.score.mot.switches() == 0);
    // It is there, and cannot be known, for 10 of 61 frames.
    CHECK(followed.score.mot.mota() >= 1.0 - (10.0 + 3.0) / 122.0);
  }
}

TEST_CASE("A track seen for a third of a second survives a gap of 0.6 s", "[tracker]") {
  for (const double from_s : {0.3, 0.4, 0.5}) {
    core::HighwayTarget target = car("A", 60.0, 0.0, kRoadSpeed_mps + 2.0);
    target.suppressed = {{from_s, from_s + 0.6}};
    const Followed followed = follow(scene(3.0, kRoadSpeed_mps, {target}));
    INFO(from_s);
    CHECK(followed.coasted >= 11);  // 0.6 s, but for how its ends are rounded
    CHECK(followed.at_end == 1);
    CHECK(followed.score.mot.switches() == 0);
    CHECK(followed.score.mot.mota() > 0.97);
  }
}

TEST_CASE("Unmeasured, a target is believed in by half after the time that was said", "[tracker]") {
  constexpr double kStep = 1e-3, kReturns = 1.0, kGone = 0.4456;
  Existence one{1.0, 0.0};
  one.missed(1.0 - 1e-9);
  CHECK(one.probability() ==
        Approx(1.0).epsilon(0.0).margin(1e-6));  // nothing can be gone that had no time
  one = {1e-6, 1.0 - 1e-6};
  for (int i = 1; i <= 2000; ++i) {
    one.pass(kStep, 1.0);
    one.missed(1.0 - 1e-9);
    const double hidden = std::exp(-(kReturns + kGone) * i * kStep);
    const double gone = kGone / (kReturns + kGone) * (1.0 - hidden);
    REQUIRE(one.probability() == Approx(hidden / (hidden + gone)).epsilon(0.0).margin(2e-3));
    if (i == 1000) CHECK(one.probability() == Approx(0.5).epsilon(0.0).margin(2e-3));
  }
  one.measured(50.0);
  CHECK(one.probability() > 1.0 - 1e-5);
  CHECK(one.hidden < 1e-5);
}

TEST_CASE("Existence of a track falls while nothing is measured of it, with either association",
          "[tracker]") {
  for (const auto association : {Association::nearest, Association::joint}) {
    TrackerSettings settings = road_tracker(highway_radar(), 0.0);
    settings.association = association;
    Tracker tracker(settings);
    const auto at = [](int i) {
      return RadarMeasurement{100.0 - 0.5 * i, -10.0, 0.0, 0.01, 0.01, 1e-3};
    };
    for (int i = 0; i < 30; ++i) tracker.update(0.05 * i, {at(i)});
    REQUIRE(tracker.tracks().size() == 1);
    CHECK(tracker.tracks()[0].existence.probability() > 0.999);
    double last = 1.0;
    for (int i = 30; i < 50; ++i) {
      tracker.update(0.05 * i, {});
      REQUIRE(tracker.tracks().size() == 1);
      CHECK(tracker.tracks()[0].existence.probability() <= last);
      last = tracker.tracks()[0].existence.probability();
    }
    CHECK(last == Approx(0.5).epsilon(0.0).margin(0.02));
    tracker.update(2.5, {at(50)});
    CHECK(tracker.tracks()[0].existence.probability() > 0.999);
  }
}

// Taking turns was 10 to 40 mrad off after ten.
TEST_CASE("Two directions two thirds of a beam apart are told to a fraction of a milliradian",
          "[sampled]") {
  constexpr int kElements = 12;
  const double wavelength_m = core::kSpeedOfLight_mps / 76e9;
  std::vector<glm::dvec3> elements_m;
  for (int i = 0; i < kElements; ++i)
    elements_m.emplace_back(0.0, (i - 5.5) * 0.5 * wavelength_m, 0.0);
  constexpr double kBeam = 0.8859 / (0.5 * kElements), kNoise_W = 1e-6;
  for (int trial = 0; trial < 30; ++trial) {
    const double left = -0.3 + 0.02 * trial, right = std::asin(std::sin(left) + 0.66 * kBeam);
    const double turn = 2.0 * core::kPi * trial / 30.0;
    std::vector<std::complex<double>> snapshot;
    for (std::size_t i = 0; i < elements_m.size(); ++i) {
      // y counts to the left.
      const double k = -2.0 * core::kPi / wavelength_m * elements_m[i].y;
      const auto noise = core::normal_pair(run_key(trial), i, 0);
      snapshot.push_back(std::polar(1.0, k * std::sin(left)) +
                         std::polar(0.8, k * std::sin(right) + turn) +
                         std::sqrt(0.5 * kNoise_W) * std::complex<double>(noise[0], noise[1]));
    }
    const auto found = directions_rad(snapshot, elements_m, wavelength_m, kBeam, kNoise_W);
    INFO(trial);
    REQUIRE(found.size() == 2);
    CHECK(found[0] == Approx(left).epsilon(0.0).margin(1e-3));
    CHECK(found[1] == Approx(right).epsilon(0.0).margin(1e-3));
  }
}

// Pairs a tenth of a cell apart in range: up to 110 false tracks in 61 frames and a NEES in the hundreds, while the
// measurement said that it is right to 5 mm and half a milliradian.
TEST_CASE("From samples, a pair that merges in range is one target, or two whose errors are told",
          "[sampled][statistics]") {
  const SampledRadar radar(highway_radar());
  for (const double range_m : {35.0, 60.0})
    for (const double apart_m : {0.05, 0.1}) {
      const Followed followed = follow(beside(range_m, apart_m, 0.0), &radar);
      INFO(range_m << " m, " << apart_m << " m apart");
      CHECK(followed.at_end >= 1);
      CHECK(followed.score.mot.false_tracks() == 0);
      CHECK(followed.score.mot.switches() == 0);
      CHECK(followed.nees.count() > 50);
      CHECK(followed.nees.mean() < 10.0);
    }
}
