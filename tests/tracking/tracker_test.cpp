// The tracker on small cases.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "tests/tracking/highway_scenes.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

RadarMeasurement at(double range_m, double rate_mps, double azimuth_rad = 0.0) {
  return {range_m, rate_mps, azimuth_rad, 0.01, 0.01, 0.001};
}

int confirmed(const Tracker& tracker) {
  return static_cast<int>(std::count_if(tracker.tracks().begin(), tracker.tracks().end(),
                                        [](const Track& one) { return one.confirmed; }));
}

}  // namespace

TEST_CASE(
    "A track is confirmed by the second good measurement, coasts twice as long as it was seen, and "
    "ends",
    "[tracker]") {
  for (const int seen : {3, 30}) {
    Tracker tracker(settings_for());
    for (int i = 0; i < seen; ++i) {
      tracker.update(0.05 * i, {at(100.0 - 0.5 * i, -10.0)});
      REQUIRE(tracker.tracks().size() == 1);
      CHECK(confirmed(tracker) == (i < 1 ? 0 : 1));
    }
    const int ends = seen + std::min(2 * seen, 20);  // at most a second
    for (int i = seen; i < ends; ++i) {
      tracker.update(0.05 * i, {});
      REQUIRE(confirmed(tracker) == 1);
      CHECK(combined(tracker.tracks()[0].state).mean[0] ==
            Approx(100.0 - 0.5 * i).epsilon(0.0).margin(0.05));
    }
    tracker.update(0.05 * ends, {});
    CHECK(tracker.tracks().empty());
  }
}

TEST_CASE("What a source knows to be wrong counts as its noise does, and nothing is added to it",
          "[tracker]") {
  Tracker one(settings_for()), other(settings_for());
  for (int i = 0; i < 5; ++i) {
    RadarMeasurement noisy = at(100.0 - 0.5 * i, -10.0 + 0.01 * i, 0.001 * i);
    RadarMeasurement wrong = noisy;
    noisy.range_sigma_m = std::hypot(0.01, 0.3);
    noisy.range_rate_sigma_mps = std::hypot(0.01, 0.2);
    noisy.azimuth_sigma_rad = std::hypot(0.001, 0.05);
    wrong.range_systematic_m = 0.3;
    wrong.range_rate_systematic_mps = 0.2;
    wrong.azimuth_systematic_rad = 0.05;
    one.update(0.05 * i, {noisy});
    other.update(0.05 * i, {wrong});
    REQUIRE(one.tracks().size() == 1);
    REQUIRE(other.tracks().size() == 1);
    const Gaussian a = combined(one.tracks()[0].state), b = combined(other.tracks()[0].state);
    for (int k = 0; k < 4; ++k) {
      const auto at_k = static_cast<std::size_t>(k);
      CHECK(a.mean[at_k] == Approx(b.mean[at_k]).epsilon(0.0).margin(1e-12));
      CHECK(a.variance(k, k) == Approx(b.variance(k, k)));
    }
    // Seen once, a track is as uncertain as the measurement.
    if (i == 0) CHECK(a.variance(0, 0) == Approx(0.01 * 0.01 + 0.3 * 0.3));
  }
  RadarMeasurement bad = at(50.0, 1.0);
  bad.range_systematic_m = -1.0;
  CHECK_THROWS_AS(one.update(1.0, {bad}), core::InputError);
  bad.range_systematic_m = std::nan("");
  CHECK_THROWS_AS(one.update(1.0, {bad}), core::InputError);
}

TEST_CASE("A single false measurement never becomes a track", "[tracker]") {
  Tracker tracker(settings_for());
  tracker.update(0.0, {at(50.0, 3.0)});
  for (int i = 1; i < 4; ++i) tracker.update(0.05 * i, {});
  CHECK(tracker.tracks().empty());
}

TEST_CASE("A tracker refuses all wrong settings together", "[tracker]") {
  TrackerSettings wrong = settings_for();
  wrong.motion.motions.clear();
  wrong.confirm_ratio = std::nan("");
  wrong.confirm_window = 1;
  wrong.detection.detection_probability = 1.0;
  wrong.believed_s = 0.0;
  std::vector<std::string> told;
  try {
    const Tracker tracker(wrong);
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems()) told.push_back(problem.field);
  }
  CHECK(told == std::vector<std::string>{"tracker.motion", "tracker.confirm_ratio",
                                         "tracker.confirm_window", "tracker.detection_probability",
                                         "tracker.believed_s"});
}

TEST_CASE("K03 K04 a tracker refuses what goes back in time or is no number, unchanged",
          "[tracker]") {
  Tracker tracker(settings_for());
  tracker.update(1.0, {at(50.0, 3.0)});
  const ImmState before = tracker.tracks()[0].state;
  CHECK_THROWS_AS(tracker.update(0.9, {}), core::InputError);
  CHECK_THROWS_AS(tracker.update(std::nan(""), {}), core::InputError);
  CHECK_THROWS_AS(tracker.update(1.1, {at(50.0, 3.0), at(std::nan(""), 3.0)}), core::InputError);
  CHECK(tracker.tracks()[0].state == before);
  tracker.update(1.0, {});
  CHECK(tracker.tracks()[0].state == before);
}

// A car that passes straight ahead, in data of whole metres: the second frame ended the run.
TEST_CASE("A track predicted onto the radar coasts, and the others go on", "[tracker]") {
  Tracker tracker(settings_for(0.0));
  tracker.update(0.0, {at(1.0, -10.0), at(60.0, -10.0)});
  for (int frame = 1; frame < 10; ++frame) tracker.update(0.1 * frame, {at(60.0 - frame, -10.0)});
  CHECK(confirmed(tracker) == 1);
  for (const Track& one : tracker.tracks())
    if (one.confirmed) CHECK(polar(one.state).range_m == Approx(51.0).epsilon(0.0).margin(0.05));
}

// 40 000 in a frame asked for 12 GB.
TEST_CASE("A frame with more measurements than can be associated is E-LIMIT, and changes nothing",
          "[tracker]") {
  Tracker tracker(settings_for());
  tracker.update(0.0, {at(50.0, 0.0)});
  const std::vector<RadarMeasurement> many(kMostMeasurements + 1, at(50.0, 0.0));
  CHECK_THROWS_WITH(tracker.update(0.25, many),
                    Catch::Contains("E-LIMIT measurements of the frame at 0.25 s = 2001: "
                                    "expected at most 2000"));
  tracker.update(0.05, {at(50.0, 0.0)});
  CHECK(confirmed(tracker) == 1);
}

TEST_CASE("Results do not depend on the order of measurements", "[tracker]") {
  for (const Association association : {Association::nearest, Association::joint}) {
    TrackerSettings settings = settings_for();
    settings.association = association;
    Tracker one(settings), other(settings);
    for (int i = 0; i < 10; ++i) {
      std::vector<RadarMeasurement> seen = {at(40.0 + i, 20.0), at(60.0, 0.0, 0.2),
                                            at(90.0 - i, -20.0, -0.1)};
      one.update(0.05 * i, seen);
      std::reverse(seen.begin(), seen.end());
      other.update(0.05 * i, seen);
    }
    REQUIRE(one.tracks().size() == other.tracks().size());
    for (const Track& track : one.tracks()) {
      const Track* twin = track_of(other, track.id);
      REQUIRE(twin != nullptr);
      CHECK(combined(track.state).mean[0] == Approx(combined(twin->state).mean[0]).epsilon(1e-12));
    }
  }
}

// Three cars and sixty measurements among them ended the run.
TEST_CASE("Joint association goes on through clutter of which the tracks share dozens",
          "[tracker]") {
  TrackerSettings settings = settings_for();
  settings.association = Association::joint;
  Tracker tracker(settings);
  const auto wide = [](double range_m, double rate_mps, double azimuth_rad) {
    return RadarMeasurement{range_m, rate_mps, azimuth_rad, 0.3, 0.1, 0.0175};
  };
  int frame = 0;
  while (frame < 20)
    tracker.update(0.05 * frame++,
                   {wide(30.0, 0.0, 0.0), wide(31.6, 0.0, 0.035), wide(33.2, 0.0, 0.07)});
  REQUIRE(confirmed(tracker) == 3);
  CHECK(tracker.left_out() == 0);
  std::vector<RadarMeasurement> clutter;
  for (int j = 0; j < 60; ++j)
    clutter.push_back(
        wide(30.4 + 0.04 * j, 0.02 * ((7 * j) % 11 - 5), 0.01 + 0.0012 * ((11 * j) % 40)));
  tracker.update(0.05 * frame, clutter);
  CHECK(tracker.left_out() > 0);
  CHECK(confirmed(tracker) == 3);
}

TEST_CASE("What is marked as clutter need not be tracked, and is no false track if it is",
          "[tracker]") {
  core::HighwayScenario scenario = one_stopped_car();
  scenario.targets.push_back(car("post", 120.0, 8.0, 0.0));
  scenario.targets[1].clutter = true;
  ScenarioScore score;
  track_scene(scenario, {}, settings_for(), 0,
              [&](const Frame& frame) { score.add(scenario, frame); });
  CHECK(score.mot.instances() == 61);
  CHECK(score.mot.false_tracks() == 0);
  CHECK(score.tracks.size() == 1);
}

TEST_CASE("A car that stands 2 m beside clutter is followed all the same", "[tracker]") {
  core::HighwayScenario scenario =
      scene(1.0, 0.0, {car("A", 60.0, 0.0, 0.0), car("post", 60.0, 2.0, 0.0)});
  scenario.targets[1].clutter = true;
  ScenarioScore score;
  run_scenario(
      scenario, highway_radar(), settings_for(0.0), [](int) { return std::vector{at(60.0, 0.0)}; },
      [&](const Frame& frame) { score.add(scenario, frame); });
  CHECK(score.mot.missed() == 1);  // the first frame
  CHECK(score.mot.false_tracks() == 0);
  CHECK(score.range_m.count() == 20);
  CHECK(score.tracks.size() == 1);
  CHECK(score.gospa_m.mean() < 0.5);
}

TEST_CASE("A new target with a tangential speed not yet known is kept from its first frames",
          "[tracker]") {
  // 25 m/s across at 80 m: the range rate changes by 0.2 m/s from frame to frame before the angle
  // has told why. A filter of first order loses it.
  core::HighwayScenario scenario = scene(0.5, 0.0, {car("B", 80.0, 57.5, 0.0, 10.0, -25.0)});
  int id = 0;
  track_scene(scenario, {}, settings_for(), 0, [&](const Frame& frame) {
    REQUIRE(frame.tracker->tracks().size() == 1);
    const Track& track = frame.tracker->tracks()[0];
    if (id == 0) id = track.id;
    CHECK(track.id == id);
    CHECK(track.coasted == 0);
  });
}

TEST_CASE(
    "Of starts from false measurements no more are confirmed than the ratio of likelihoods says",
    "[tracker][statistics]") {
  core::HighwayScenario empty = scene(0.5, kRoadSpeed_mps, {});
  SimulationSettings simulation;
  simulation.false_per_frame = 60.0;
  TrackerSettings settings = settings_for();
  settings.detection.clutter_density = 60.0 / (200.0 * 140.0 * 2.0944);
  for (const double ratio : {30.0, 1000.0}) {
    settings.confirm_ratio = ratio;
    int confirmed_tracks = 0, starts = 0;
    for (int run = 0; run < 60; ++run)
      track_scene(empty, simulation, settings, run, [&](const Frame& frame) {
        for (const Track& track : frame.tracker->tracks()) {
          starts += track.frames == 1;
          confirmed_tracks += track.confirmed && track.frames == 2;
        }
      });
    INFO(confirmed_tracks << " of " << starts << " at " << ratio);
    CHECK(starts > 30000);
    CHECK(confirmed_tracks <= starts / ratio);
  }
}

TEST_CASE("A pair unresolved for too long is given up, and set aside again at the next crossing",
          "[tracker]") {
  TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  int frame = 0;
  double apart_m = 4.0;
  const auto step = [&](double change_m, bool both) {
    apart_m += change_m;
    std::vector<RadarMeasurement> seen = {at(60.0, 0.0)};
    if (both) seen.push_back(at(60.0 + apart_m, 20.0 * change_m, 0.001));
    tracker.update(0.05 * frame++, seen);
  };
  const auto aside = [&] {
    return std::count_if(tracker.tracks().begin(), tracker.tracks().end(),
                         [](const Track& one) { return one.unresolved_with.has_value(); });
  };
  while (apart_m > 1.2) step(-0.04, true);
  REQUIRE(confirmed(tracker) == 2);
  step(0.0, false);
  REQUIRE(aside() == 2);
  // As one for 8 s: after 6 s both take part again, and one of them gets nothing more.
  for (int i = 0; i < 115; ++i) step(0.0, false);
  CHECK(aside() == 2);
  for (int i = 0; i < 45; ++i) step(0.0, false);
  CHECK(aside() == 0);
  REQUIRE(confirmed(tracker) == 1);
  // Which of the two goes on nobody knows.
  REQUIRE(tracker.crossings().size() == 1);
  CHECK(tracker.crossings()[0].given_up);
  CHECK(tracker.crossings()[0].swap_probability == 0.5);
  const auto goes_on = std::find_if(tracker.tracks().begin(), tracker.tracks().end(),
                                    [](const Track& one) { return one.confirmed; });
  CHECK(goes_on->identity_probability == 0.5);
  // Apart again, and together a second time.
  apart_m = 4.0;
  for (int i = 0; i < 20; ++i) step(-0.04, true);
  REQUIRE(confirmed(tracker) == 2);
  std::vector<int> ids;
  for (const Track& track : tracker.tracks())
    if (track.confirmed) ids.push_back(track.id);
  while (apart_m > 1.2) step(-0.04, true);
  for (int i = 0; i < 10; ++i) {
    step(0.0, false);
    CHECK(aside() == 2);
  }
  for (const int id : ids) CHECK(track_of(tracker, id) != nullptr);
}

// Set aside for seconds, a pair's gates reach over tens of metres: one of the two took the third car's measurement.
TEST_CASE("An unresolved pair leaves the measurements of a third car to its track", "[tracker]") {
  const TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  int frame = 0;
  const auto step = [&](double apart_m) {
    std::vector<RadarMeasurement> seen = {at(60.0, 0.0), at(85.0, 0.3 * frame * 0.05, 0.02)};
    seen.back().range_m += 0.15 * std::pow(0.05 * frame, 2.0);
    if (apart_m > 0.0) seen.push_back(at(60.0 + apart_m, -0.8, 0.001));
    tracker.update(0.05 * frame++, seen);
  };
  for (double apart_m = 4.0; apart_m > 1.2; apart_m -= 0.04) step(apart_m);
  REQUIRE(confirmed(tracker) == 3);
  std::vector<int> ids;
  for (const Track& track : tracker.tracks()) ids.push_back(track.id);
  for (int i = 0; i < 100; ++i) {
    step(0.0);
    int aside = 0, measured = 0;
    for (const int id : ids) {
      const Track* const track = track_of(tracker, id);
      REQUIRE(track != nullptr);
      aside += track->unresolved_with.has_value();
      measured += track->coasted == 0;
    }
    REQUIRE(aside == 2);
    REQUIRE(measured == 1);
  }
  CHECK(tracker.crossings().empty());
}

// It was taken for one that had begun on the pair's own echo: the pair parted, and one of it ran 12 m to the third car.
TEST_CASE("A third car that appears beside an unresolved pair keeps its measurements",
          "[tracker]") {
  for (const double third_m : {72.0, 85.0}) {
    INFO(third_m);
    const TrackerSettings settings = settings_for();
    Tracker tracker(settings);
    int frame = 0;
    const auto step = [&](double apart_m, bool third) {
      std::vector<RadarMeasurement> seen = {at(60.0, 0.0)};
      if (third) seen.push_back(at(third_m, 0.0, 0.02));
      if (apart_m > 0.0) seen.push_back(at(60.0 + apart_m, -0.8, 0.001));
      tracker.update(0.05 * frame++, seen);
    };
    for (double apart_m = 4.0; apart_m > 1.2; apart_m -= 0.04) step(apart_m, false);
    REQUIRE(confirmed(tracker) == 2);
    for (int i = 0; i < 20; ++i) step(0.0, false);
    for (int i = 0; i < 80; ++i) step(0.0, true);
    CHECK(confirmed(tracker) == 3);
    CHECK(tracker.crossings().empty());
    CHECK(std::count_if(tracker.tracks().begin(), tracker.tracks().end(),
                        [](const Track& one) { return one.unresolved_with.has_value(); }) == 2);
  }
}

// It kept nothing from any later pair with one of them: the second pair parted by its echo, 32 m away.
TEST_CASE("A car that began on a pair's echo keeps its measurements from the next pair",
          "[tracker]") {
  Tracker tracker(settings_for());
  int frame = 0;
  const auto step = [&](const std::vector<RadarMeasurement>& seen) {
    tracker.update(0.05 * frame++, seen);
  };
  // One drives past another as one echo, at last between the two places: a third track begins there.
  double passing_m = 64.0;
  for (; passing_m > 61.2; passing_m -= 0.04) step({at(60.0, 0.0), at(passing_m, -0.8, 0.001)});
  for (int i = 0; i < 100; ++i, passing_m -= 0.04) step({at(60.0, 0.0)});
  for (int i = 0; i < 3; ++i, passing_m -= 0.04) step({at(0.5 * (60.0 + passing_m), -0.4)});
  REQUIRE(confirmed(tracker) == 3);
  REQUIRE(tracker.tracks()[2].began_on.has_value());
  // All three are seen, and the third drives away.
  double third_m = 0.5 * (60.0 + passing_m), third_mps = -0.4;
  for (int i = 0; i < 140; ++i, passing_m -= 0.04) {
    third_mps = std::min(third_mps + 0.1, 5.0);
    third_m += 0.05 * third_mps;
    step({at(60.0, 0.0), at(passing_m, -0.8, 0.001),
          at(third_m, third_mps, 0.0002 * std::min(i, 100))});
  }
  REQUIRE(tracker.crossings().size() == 1);
  REQUIRE(confirmed(tracker) == 3);
  CHECK_FALSE(tracker.tracks()[2].began_on.has_value());
  // It stands 32 m away while another car drives past the first.
  for (double next_m = 64.0; next_m > 61.2; next_m -= 0.04) {
    third_mps = std::max(third_mps - 0.1, 0.0);
    third_m += 0.05 * third_mps;
    step({at(60.0, 0.0), at(next_m, -0.8, 0.001), at(third_m, third_mps, 0.02)});
  }
  for (int i = 0; i < 80; ++i) step({at(60.0, 0.0), at(third_m, 0.0, 0.02)});
  CHECK(tracker.crossings().size() == 1);
  CHECK(confirmed(tracker) == 3);
  CHECK(std::count_if(tracker.tracks().begin(), tracker.tracks().end(),
                      [](const Track& one) { return one.unresolved_with.has_value(); }) == 2);
}

// The echo of one pair lies in the swollen gates of the other. For 4.5 s; after 4.8 the gates are so wide, 50 m
// along the way, that one pair takes the other's echo for one of its cars.
TEST_CASE("Two unresolved pairs leave each other's echoes alone", "[tracker]") {
  const TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  int frame = 0;
  const auto step = [&](double apart_m) {
    std::vector<RadarMeasurement> seen = {at(60.0, 0.0), at(72.0, 0.0, 0.02)};
    if (apart_m > 0.0) {
      seen.push_back(at(60.0 + apart_m, -0.8, 0.001));
      seen.push_back(at(72.0 + apart_m, -0.8, 0.021));
    }
    tracker.update(0.05 * frame++, seen);
  };
  for (double apart_m = 4.0; apart_m > 1.2; apart_m -= 0.04) step(apart_m);
  REQUIRE(confirmed(tracker) == 4);
  for (int i = 0; i < 90; ++i) {
    step(0.0);
    REQUIRE(std::count_if(tracker.tracks().begin(), tracker.tracks().end(), [](const Track& one) {
              return one.confirmed && one.unresolved_with.has_value();
            }) == 4);
  }
  CHECK(tracker.crossings().empty());
}

// The third takes the one echo; the pair is in it as well, and drives out again.
TEST_CASE("Of three cars in one cell none is lost", "[tracker]") {
  const TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  int frame = 0;
  const auto step = [&](double apart_m, bool merged) {
    std::vector<RadarMeasurement> seen = {at(60.0, 0.0)};
    if (!merged) {
      seen.push_back(at(60.0 + apart_m, -0.8, 0.001));
      seen.push_back(at(60.0 - apart_m, 0.8, -0.001));
    }
    tracker.update(0.05 * frame++, seen);
  };
  for (double apart_m = 4.0; apart_m > 1.0; apart_m -= 0.04) step(apart_m, false);
  REQUIRE(confirmed(tracker) == 3);
  for (int i = 0; i < 40; ++i) step(0.0, true);
  CHECK(confirmed(tracker) == 3);
  // On the other side of the one that stands, where 2 s at 0.8 m/s have brought them.
  for (double apart_m = -0.64; apart_m > -5.0; apart_m -= 0.04) step(apart_m, false);
  std::vector<double> ranges_m;
  for (const Track& track : tracker.tracks())
    if (track.confirmed) ranges_m.push_back(combined(track.state).mean[0]);
  std::sort(ranges_m.begin(), ranges_m.end());
  REQUIRE(ranges_m.size() == 3);
  for (const std::size_t i : {0U, 1U, 2U})
    CHECK(ranges_m[i] == Approx(55.04 + 4.96 * double(i)).epsilon(0.0).margin(0.2));
}

TEST_CASE("Frames that are missing end an unresolved pair as they end any track", "[tracker]") {
  const TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  double time_s = 0.0;
  for (double apart_m = 4.0; apart_m > 1.2; apart_m -= 0.04, time_s += 0.05)
    tracker.update(time_s, {at(60.0, 0.0), at(60.0 + apart_m, -0.8, 0.001)});
  tracker.update(time_s, {at(60.0, 0.0)});
  REQUIRE(confirmed(tracker) == 2);
  REQUIRE(tracker.tracks()[0].unresolved_with.has_value());
  tracker.update(time_s + settings.longest_gap_s + 0.01, {at(60.0, 0.0)});
  CHECK(confirmed(tracker) == 0);
}

// Two cars that a lorry hides are no surer than one.
TEST_CASE("An unresolved pair of which nothing is measured coasts and ends as any track",
          "[tracker]") {
  const TrackerSettings settings = settings_for();
  Tracker tracker(settings);
  int frame = 0;
  double apart_m = 4.0;
  for (; apart_m > 1.2; apart_m -= 0.04)
    tracker.update(0.05 * frame++, {at(60.0, 0.0), at(60.0 + apart_m, -0.8, 0.001)});
  REQUIRE(confirmed(tracker) == 2);
  for (int i = 0; i < 10; ++i) tracker.update(0.05 * frame++, {at(60.0, 0.0)});
  REQUIRE(confirmed(tracker) == 2);
  const double before = tracker.tracks()[0].existence.probability();
  for (int i = 0; i < settings.most_coasted; ++i) {
    tracker.update(0.05 * frame++, {});
    REQUIRE(confirmed(tracker) == 2);
  }
  CHECK(tracker.tracks()[0].existence.probability() < 0.9 * before);
  for (int i = 0; i < 2; ++i) tracker.update(0.05 * frame++, {});
  CHECK(confirmed(tracker) == 0);
}

TEST_CASE("A track whose partner is gone takes part again with all of its coasting before it",
          "[tracker]") {
  // Both are one from the third frame on; the right one drifts out of the field of view.
  TrackerSettings settings = settings_for();
  settings.most_azimuth_rad = 0.09;
  Tracker tracker(settings);
  int frame = 0;
  for (; frame < 3; ++frame)
    tracker.update(0.05 * frame, {at(60.0, 0.0, -0.04), at(60.0, 0.0, 0.05 + 0.002 * frame)});
  REQUIRE(confirmed(tracker) == 2);
  const int id = tracker.tracks()[0].id;
  for (; frame < 100 && confirmed(tracker) == 2; ++frame)
    tracker.update(0.05 * frame, {at(60.0, 0.0, -0.04)});
  REQUIRE(confirmed(tracker) == 1);
  REQUIRE(frame > settings.most_coasted + 5);
  for (int last = frame + 3; frame < last; ++frame) tracker.update(0.05 * frame, {});
  REQUIRE(confirmed(tracker) == 1);
  CHECK(tracker.tracks()[0].id == id);
  CHECK_FALSE(tracker.tracks()[0].unresolved_with.has_value());
  CHECK(tracker.tracks()[0].coasted <= 4);
  tracker.update(0.05 * frame, {at(60.0, 0.0, -0.04)});
  CHECK(tracker.tracks()[0].coasted == 0);
  CHECK(tracker.tracks()[0].id == id);
}
