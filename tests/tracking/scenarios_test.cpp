// The four road scenarios with their acceptance figures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.h"
#include "tests/tracking/highway_scenes.h"
#include "tracking/metrics/error_statistics.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

TEST_CASE("S1 a single car: errors within 1.15 of the bound, no false track",
          "[tracker][statistics]") {
  SimulationSettings simulation;
  MeanSquare range, rate;
  MeanSquare range_in_bounds, rate_in_bounds;
  int tracks = 0, detected = 0, frames = 0;
  double least_mota = 1.0;
  for (int run = 0; run < 200; ++run) {
    std::set<int> ids;
    ScenarioScore score;
    const core::HighwayScenario scenario = one_stopped_car();
    track_scene(scenario, simulation, settings_for(), run, [&](const Frame& frame) {
      ++frames;
      score.add(scenario, frame);
      detected += !frame.measurements.empty();
      for (const Track& track : frame.tracker->tracks()) {
        if (!track.confirmed) continue;
        ids.insert(track.id);
        const PolarPlace place = polar(track.state);
        const MeasurementBound bound =
            measurement_bound(highway_radar(), 10.0, frame.truth[0].range_m, 0.0);
        range.add(place.range_m - frame.truth[0].range_m);
        rate.add(place.range_rate_mps - frame.truth[0].range_rate_mps);
        range_in_bounds.add((place.range_m - frame.truth[0].range_m) / bound.range_sigma_m);
        rate_in_bounds.add((place.range_rate_mps - frame.truth[0].range_rate_mps) /
                           bound.range_rate_sigma_mps);
      }
    });
    tracks += static_cast<int>(ids.size());
    least_mota = std::min(least_mota, score.mot.mota());
  }
  INFO("S1: range " << range.rms() << " m (" << range_in_bounds.rms() << " bounds), largest "
                    << range.largest() << " m, least MOTA " << least_mota << ", speed "
                    << rate.rms() << " m/s (" << rate_in_bounds.rms() << ")");
  CHECK(tracks == 200);
  CHECK(least_mota >= 0.98);
  CHECK(detected >= 0.999 * frames);
  CHECK(range.largest() < 1.0);
  CHECK(range.rms() <= 0.01);
  CHECK(rate.rms() <= 0.01);
  CHECK(range_in_bounds.rms() <= 1.15);
  CHECK(rate_in_bounds.rms() <= 1.15);
}

TEST_CASE("S1 tracks of a point target err by at most 1.15 of the posterior bound",
          "[tracker][statistics]") {
  // J' = (Q + F J^-1 F^T)^-1 + R^-1 along the line of sight, for range and speed as measured and the
  // unknown acceleration of 0.5 m/s2 that the tracker assumes (P. Tichavsky, C. H. Muravchik, A.
  // Nehorai, IEEE Trans. SP-46, 1998). The car has none, so the bound is not one for these runs
  // alone; it is what any filter of that model must expect. Tracker and
  // measurements are those that everybody gets: floors of 5 mm and 5 mm/s would make it 1.44 in
  // range.
  const TrackerSettings settings = settings_for();
  constexpr double kStep = 0.05, kVariance = 0.25;
  MeanSquare range, rate;
  for (int run = 0; run < 200; ++run) {
    double p = 0.0, c = 0.0, v = 0.0;  // covariance of range and speed
    track_scene(one_stopped_car(), {}, settings, run, [&](const Frame& frame) {
      const auto& truth = frame.truth[0];
      const MeasurementBound bound = measurement_bound(highway_radar(), 10.0, truth.range_m, 0.0);
      const double r = std::pow(bound.range_sigma_m, 2);
      const double s = std::pow(bound.range_rate_sigma_mps, 2);
      if (frame.time_s == 0.0) {
        p = r;
        v = s;
        return;
      }
      p += 2.0 * kStep * c + kStep * kStep * v + kVariance * std::pow(kStep, 4) / 4.0;
      c += kStep * v + kVariance * std::pow(kStep, 3) / 2.0;
      v += kVariance * kStep * kStep;
      const double before = p * v - c * c;
      const double a = v / before + 1.0 / r, b = -c / before, d = p / before + 1.0 / s;
      const double after = a * d - b * b;
      p = d / after;
      c = -b / after;
      v = a / after;
      for (const Track& track : frame.tracker->tracks()) {
        if (!track.confirmed || frame.time_s < 0.5) continue;
        const PolarPlace place = polar(track.state);
        range.add((place.range_m - truth.range_m) / std::sqrt(p));
        rate.add((place.range_rate_mps - truth.range_rate_mps) / std::sqrt(v));
      }
    });
  }
  INFO("S1 over the posterior bound: range " << range.rms() << ", speed " << rate.rms());
  CHECK(range.rms() <= 1.15);
  CHECK(rate.rms() <= 1.15);
}

TEST_CASE("S2 six vehicles: no ghost track, no switch, GOSPA below 0.5 m",
          "[tracker][statistics]") {
  for (const Scheme scheme : {Scheme::two_stage, Scheme::two_slopes})
    for (const Association association : {Association::nearest, Association::joint}) {
      SimulationSettings simulation;
      simulation.scheme = scheme;
      TrackerSettings settings = settings_for();
      settings.association = association;
      MeanSquare gospa_m;
      double least_mota = 1.0;
      int switches = 0, ghosts = 0;
      constexpr int kRuns = 100;
      for (int run = 0; run < kRuns; ++run) {
        ScenarioScore score;
        const core::HighwayScenario scenario = six_vehicles();
        track_scene(scenario, simulation, settings, run,
                    [&](const Frame& frame) { score.add(scenario, frame); });
        gospa_m.add(score.gospa_m.mean());
        ghosts += static_cast<int>(score.tracks.size()) - 6;
        switches += score.mot.switches();
        least_mota = std::min(least_mota, score.mot.mota());
      }
      INFO("S2 scheme " << static_cast<int>(scheme) << " association "
                        << static_cast<int>(association) << ": GOSPA " << gospa_m.mean()
                        << " m, least MOTA " << least_mota << ", ghosts " << ghosts << ", switches "
                        << switches);
      CHECK(gospa_m.mean() <= 0.5);
      CHECK(least_mota >= 0.98);
      CHECK(ghosts == 0);
      CHECK(switches == 0);
    }
}

TEST_CASE("Two to six targets: as many tracks, GOSPA below 0.5 m", "[tracker][statistics]") {
  for (std::size_t count = 2; count <= 6; ++count) {
    core::HighwayScenario scenario = six_vehicles();
    scenario.targets.resize(count);
    for (int run = 0; run < 20; ++run) {
      INFO(count << " targets, run " << run);
      ScenarioScore score;
      track_scene(scenario, {}, settings_for(), run,
                  [&](const Frame& frame) { score.add(scenario, frame); });
      CHECK(score.tracks.size() == count);
      CHECK(score.gospa_m.mean() <= 0.5);
      CHECK(score.mot.mota() >= 0.98);
      CHECK(score.mot.switches() == 0);
    }
  }
}

TEST_CASE("S3 two cars that cross at 3 km/h keep their identity", "[tracker][statistics]") {
  for (const Scheme scheme : {Scheme::triangle, Scheme::two_stage}) {
    SimulationSettings simulation;
    simulation.scheme = scheme;
    int kept = 0, breaks = 0;
    double brier = 0.0, told = 0.0;
    MeanSquare range_rms;
    double largest_m = 0.0;
    constexpr int kRuns = 200;
    for (int run = 0; run < kRuns; ++run) {
      ScenarioScore score;
      std::map<int, int> first;
      double identity = 1.0;
      const core::HighwayScenario scenario = slow_crossing();
      track_scene(scenario, simulation, settings_for(), run, [&](const Frame& frame) {
        score.add(scenario, frame);
        if (frame.time_s > 1.0 && first.empty()) first = score.mot.last_match();
        for (const Track& track : frame.tracker->tracks())
          if (track.confirmed) identity = std::min(identity, track.identity_probability);
      });
      const bool same = score.mot.last_match() == first && score.mot.switches() == 0;
      kept += same;
      breaks += static_cast<int>(score.tracks.size()) - 2;
      range_rms.add(score.range_m.rms());
      largest_m = std::max(largest_m, score.range_m.largest());
      told += identity / kRuns;
      brier += std::pow(identity - (same ? 1.0 : 0.0), 2) / kRuns;
    }
    INFO("S3 scheme " << static_cast<int>(scheme) << ": kept " << kept << " of " << kRuns
                      << ", told " << told << ", Brier " << brier << ", further tracks " << breaks
                      << ", range " << range_rms.rms() << " m, largest " << largest_m);
    CHECK(kept >= 0.99 * kRuns);
    CHECK(breaks == 0);
    CHECK(range_rms.rms() <= 0.1);
    CHECK(largest_m <= 1.0);
    CHECK(brier <= 0.02);
    // The tracker allows for cars that turn while they are one, which these do not: of the triangle's merged beats
    // alone it is less sure than it could be.
    const double margin = scheme == Scheme::triangle ? 0.14 : 0.03;
    CHECK(told == Approx(static_cast<double>(kept) / kRuns).epsilon(0.0).margin(margin));
  }
}

TEST_CASE("S4 beaming targets show their speed in the angle alone", "[tracker][statistics]") {
  SimulationSettings simulation;
  const TrackerSettings settings = settings_for(0.0);
  const core::HighwayScenario scenario = beaming();
  MeanSquare speed_a, speed_b, rate_a;
  int moving = 0, seen_a = 0, kept = 0;
  double least_mota = 1.0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    ClearMot metric(3.0);
    std::map<int, int> first;
    track_scene(scenario, simulation, settings, run, [&](const Frame& frame) {
      metric.add_frame(frame.targets(scenario), frame.confirmed());
      if (frame.time_s < 1.0) return;
      if (first.empty()) first = metric.last_match();
      for (const auto& [target, id] : metric.last_match()) {
        const Track* track = track_of(*frame.tracker, id);
        if (track == nullptr || target == 2) continue;
        const Gaussian state = combined(track->state);
        const auto& motion = frame.motion[static_cast<std::size_t>(target)];
        const double range_m = std::hypot(motion.position_m[0], motion.position_m[1]);
        const double tx = -motion.position_m[1] / range_m, ty = motion.position_m[0] / range_m;
        const double error = tx * (state.mean[2] - motion.velocity_mps[0]) +
                             ty * (state.mean[3] - motion.velocity_mps[1]);
        (target == 0 ? speed_a : speed_b).add(error);
        if (target != 0) continue;
        rate_a.add(polar(track->state).range_rate_mps);
        ++seen_a;
        moving += is_moving(*track, {0.0, 0.0});
      }
    });
    const auto last = metric.last_match();
    kept += last.count(0) && last.count(2) && last.at(0) == first[0] && last.at(2) == first[2] &&
            metric.switches() == 0;
    least_mota = std::min(least_mota, metric.mota());
  }
  INFO("S4: least MOTA " << least_mota << ", tangential " << speed_a.rms() << " and "
                         << speed_b.rms() << " m/s, range rate mean " << rate_a.mean()
                         << " m/s, moving " << moving / double(seen_a) << ", kept " << kept
                         << " of " << kRuns);
  CHECK(speed_a.rms() <= 0.75);
  CHECK(speed_b.rms() <= 1.0);
  CHECK(std::abs(rate_a.mean()) <= 0.02);
  CHECK(moving >= 0.95 * seen_a);
  CHECK(kept >= 0.98 * kRuns);
  CHECK(least_mota >= 0.98);
}

TEST_CASE("Missed and false measurements neither break tracks nor make any",
          "[tracker][statistics]") {
  for (const Association association : {Association::nearest, Association::joint}) {
    SimulationSettings simulation;
    simulation.detection_probability = 0.9;
    simulation.false_per_frame = 5.0;
    TrackerSettings settings = settings_for();
    settings.association = association;
    settings.detection.detection_probability = 0.9;
    // Of 200 m x 140 m/s x 2.09 rad.
    settings.detection.clutter_density = 5.0 / (200.0 * 140.0 * 2.09);
    double least_mota = 1.0;
    int switches = 0, further = 0;
    MeanSquare gospa_m;
    for (int run = 0; run < 20; ++run) {
      ScenarioScore score;
      const core::HighwayScenario scenario = six_vehicles();
      track_scene(scenario, simulation, settings, run,
                  [&](const Frame& frame) { score.add(scenario, frame); });
      gospa_m.add(score.gospa_m.mean());
      further += static_cast<int>(score.tracks.size()) - 6;
      switches += score.mot.switches();
      least_mota = std::min(least_mota, score.mot.mota());
    }
    INFO("with false measurements, association "
         << static_cast<int>(association) << ": MOTA " << least_mota << ", GOSPA " << gospa_m.mean()
         << " m, further tracks " << further << ", switches " << switches);
    CHECK(least_mota >= 0.95);
    CHECK(gospa_m.mean() <= 0.5);
    CHECK(switches == 0);
    CHECK(further == 0);
  }
}
