// K06: filters are as good as they say, over fixed runs with matched noise.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"
#include "tracking/filters/chi_square.h"
#include "tracking/filters/kalman.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::kStep_s;
using tests::line;
using tests::line_state;
using tests::run_key;
using tests::seen;

TEST_CASE("K06 innovations and errors of matched runs are as large as the filter says",
          "[kalman][statistics]") {
  constexpr int kRuns = 50, kSteps = 100;
  double innovations = 0.0, errors = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = core::normal_pair(run_key(run), 0, 0);
    double position_m = 3.0 * start[0], speed_mps = 2.0 * start[1];
    Gaussian state = line_state(3.0, 2.0);
    Update told;
    for (int step = 1; step <= kSteps; ++step) {
      const auto cell = static_cast<std::uint64_t>(step);
      const double a_mps2 = core::normal_pair(run_key(run), cell, 1)[0];
      position_m += speed_mps * kStep_s + 0.5 * a_mps2 * kStep_s * kStep_s;
      speed_mps += a_mps2 * kStep_s;
      const auto noise = core::normal_pair(run_key(run), cell, 2);
      predict(line(), kStep_s, state);
      told = update(
          state, observe(state, 1, Measured::range_and_rate,
                         seen(position_m + 0.1 * noise[0], speed_mps + 0.1 * noise[1], 0.1, 0.1)));
    }
    innovations += told.normalised_innovation_squared / kRuns;
    errors += normalised_error_squared(state, {position_m, speed_mps}) / kRuns;
  }
  CHECK(mean_interval(2, kRuns).contains(innovations));
  CHECK(mean_interval(2, kRuns).contains(errors));
}

// A filter in its steady state, with noise w of acceleration expected and none there: in continuous time
// its error has the damping 1/sqrt 2, and noise of the measurement alone leaves 3/4 of the variance told in
// position, 1/4 in speed, and a normalised error squared of 1 for the pair instead of 2, whatever w is.
// So a car that keeps its speed across the line of sight brings it, of four states, from 4 down to 3.
TEST_CASE(
    "A target without the noise expected has half the normalised error, however little that is",
    "[kalman]") {
  for (const double acceleration_mps2 : {0.01, 0.001}) {
    MotionModel model = line(acceleration_mps2);
    constexpr double kSigma_m = 0.05;
    Gaussian state = line_state(1.0, 1.0);
    double xx = 1.0, xv = 0.0, vv = 1.0;  // of the error that is there
    for (int step = 0; step < 40000; ++step) {
      predict(model, kStep_s, state);
      const Update told = update(
          state, observe(state, 1, Measured::range, seen(state.mean[0], 0.0, kSigma_m, 0.0)));
      const double k = told.gain[0], l = told.gain[kMostStates];
      const double ahead = xx + 2.0 * kStep_s * xv + kStep_s * kStep_s * vv;
      const double across = xv + kStep_s * vv;
      const double noise_m2 = kSigma_m * kSigma_m;
      xv = (1.0 - k) * (across - l * ahead) + k * l * noise_m2;
      vv = vv - 2.0 * l * across + l * l * (ahead + noise_m2);
      xx = (1.0 - k) * (1.0 - k) * ahead + k * k * noise_m2;
    }
    const double a = state.variance(0, 0), b = state.variance(0, 1), c = state.variance(1, 1);
    INFO(acceleration_mps2 << " m/s2");
    CHECK((c * xx - 2.0 * b * xv + a * vv) / (a * c - b * b) == Approx(1.0).epsilon(0.03));
    CHECK(xx / a == Approx(0.75).epsilon(0.03));
    CHECK(vv / c == Approx(0.25).epsilon(0.03));
  }
}

TEST_CASE("The planar filter is consistent with range, rate and azimuth", "[kalman][statistics]") {
  constexpr int kRuns = 100, kSteps = 60;
  MotionModel model;
  double innovations = 0.0, errors = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const auto key = run_key(run, 1001);
    Gaussian state;
    state.size = 4;
    state.mean = {80.0, 5.0, -10.0, 1.0};
    for (int i = 0; i < 4; ++i) state.variance(i, i) = i < 2 ? 0.25 : 1.0;
    StateVector truth = state.mean;
    const auto p = core::normal_pair(key, 0, 0), v = core::normal_pair(key, 0, 1);
    for (std::size_t i = 0; i < 2; ++i) {
      truth[i] += 0.5 * p[i];
      truth[i + 2] += v[i];
    }
    Update told;
    for (int step = 1; step <= kSteps; ++step) {
      const auto cell = static_cast<std::uint64_t>(step);
      const auto a = core::normal_pair(key, cell, 2);
      for (std::size_t i = 0; i < 2; ++i) {
        truth[i] += truth[i + 2] * kStep_s + 0.5 * a[i] * kStep_s * kStep_s;
        truth[i + 2] += a[i] * kStep_s;
      }
      const auto n = core::normal_pair(key, cell, 3), n2 = core::normal_pair(key, cell, 4);
      const double range_m = std::hypot(truth[0], truth[1]);
      const RadarMeasurement z{range_m + 0.1 * n[0],
                               (truth[0] * truth[2] + truth[1] * truth[3]) / range_m + 0.1 * n[1],
                               std::atan2(truth[1], truth[0]) + 0.005 * n2[0],
                               0.1,
                               0.1,
                               0.005};
      predict(model, kStep_s, state);
      told = update(state, observe(state, 2, Measured::range_rate_and_azimuth, z));
    }
    innovations += told.normalised_innovation_squared / kRuns;
    errors += normalised_error_squared(state, truth) / kRuns;
  }
  CHECK(mean_interval(3, kRuns).contains(innovations));
  CHECK(mean_interval(4, kRuns).contains(errors));
}

TEST_CASE("Tracks of measurements from frequencies are as good as they say, by default",
          "[tracker][statistics]") {
  // A radar of one element, so that all of a track lies on the line of sight, and a car that
  // accelerates as the tracker assumes: matched. A floor of 5 mm would bring the mean to 0.04.
  core::HighwayRadar radar = tests::highway_radar();
  radar.array_elements = 1;
  constexpr int kRuns = 100;
  double errors = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    core::HighwayScenario scenario = tests::one_stopped_car();
    for (int step = 0; step < 60; ++step) {
      const double a_mps2 =
          0.5 * core::normal_pair(run_key(run, 1005), static_cast<std::uint64_t>(step), 0)[0];
      scenario.targets[0].accelerations.push_back(
          {step * kStep_s, (step + 1) * kStep_s, {a_mps2, 0.0}});
    }
    Gaussian last;
    std::array<double, 2> truth{};
    run_scenario(scenario, radar, {}, road_tracker(radar, scenario.radar_speed_mps), 31,
                 static_cast<std::uint32_t>(run), [&](const ScenarioFrame& frame) {
                   REQUIRE(frame.tracker->tracks().size() == 1);
                   last = combined(frame.tracker->tracks()[0].state);
                   truth = {frame.truth[0].range_m, frame.truth[0].range_rate_mps};
                 });
    errors += normalised_error_squared(last, {truth[0], truth[1]}) / kRuns;
  }
  INFO("normalised squared error " << errors);
  CHECK(mean_interval(2, kRuns).contains(errors));
}

TEST_CASE("Errors of six tracks are as large as told, merged beats and all",
          "[tracker][statistics]") {
  // Cars that drive straight on, which the tracker does not know: somewhat below 1.
  const core::HighwayScenario scenario = tests::six_vehicles();
  const core::HighwayRadar radar = tests::highway_radar();
  MeanSquare range, azimuth;
  for (int run = 0; run < 20; ++run) {
    ScenarioScore score;
    const auto each = [&](const ScenarioFrame& frame) {
      score.add(scenario, frame);
      for (const auto& [target, id] : score.mot.current_match())
        for (const Track& track : frame.tracker->tracks()) {
          if (track.id != id) continue;
          const Gaussian state = combined(track.state);
          const core::HighwayTruth& truth = frame.truth[static_cast<std::size_t>(target)];
          const double x_m = state.mean[0], y_m = state.mean[1], range_m = std::hypot(x_m, y_m);
          // Variance of position along a direction.
          const auto variance = [&](double x, double y) {
            return x * x * state.variance(0, 0) + 2.0 * x * y * state.variance(0, 1) +
                   y * y * state.variance(1, 1);
          };
          range.add((range_m - truth.range_m) / std::sqrt(variance(x_m / range_m, y_m / range_m)));
          azimuth.add((std::atan2(y_m, x_m) - truth.azimuth_rad) * range_m /
                      std::sqrt(variance(-y_m / range_m, x_m / range_m)));
        }
    };
    run_scenario(scenario, radar, {}, road_tracker(radar, scenario.radar_speed_mps), 32,
                 static_cast<std::uint32_t>(run), each);
  }
  INFO("over the deviation told: range " << range.rms() << ", azimuth " << azimuth.rms());
  CHECK(range.rms() == Approx(0.95).epsilon(0.0).margin(0.1));
  CHECK(azimuth.rms() == Approx(0.95).epsilon(0.0).margin(0.1));
}
