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

namespace {

// A filter of order n in its steady state: position is the n-th integral of white noise, which a target at rest does
// not have; position alone is measured. The normalised error squared of position and speed, 2 for a target that has it.
constexpr double kUnmovedSigma_m = 0.05;
struct Unmoved {
  double position, speed, both;  // over the variances told
};

Unmoved unmoved(int order, double density) {
  using Square = std::array<std::array<double, kMostStates>, kMostStates>;
  std::array<double, 2 * kMostStates> power{};  // T^i / i!
  power[0] = 1.0;
  for (std::size_t i = 1; i < power.size(); ++i)
    power[i] = power[i - 1] * kStep_s / static_cast<double>(i);
  const auto n = static_cast<std::size_t>(order);
  const auto moved = [&](const Square& of) {
    Square result{};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t i = r; i < n; ++i)
          for (std::size_t j = c; j < n; ++j)
            result[r][c] += power[i - r] * of[i][j] * power[j - c];
    return result;
  };
  Gaussian state;
  state.size = order;
  Square error{};  // that is there
  for (int i = 0; i < order; ++i) state.variance(i, i) = 1.0;
  for (std::size_t i = 0; i < n; ++i) error[i][i] = 1.0;
  for (int step = 0; step < 6000; ++step) {
    Square told{};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c)
        told[r][c] = state.variance(static_cast<int>(r), static_cast<int>(c));
    told = moved(told);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t a = n - 1 - r, b = n - 1 - c;
        state.variance(static_cast<int>(r), static_cast<int>(c)) =
            told[r][c] + density * power[a] * power[b] * kStep_s / static_cast<double>(a + b + 1);
      }
    Observation one;
    one.size = 1;
    one.noise[0] = kUnmovedSigma_m * kUnmovedSigma_m;
    one.jacobian[0] = 1.0;
    const Update update_told = update(state, one);
    const Square ahead = moved(error);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) {
        const double k = update_told.gain[r * kMostStates], l = update_told.gain[c * kMostStates];
        error[r][c] = ahead[r][c] - k * ahead[0][c] - l * ahead[r][0] +
                      k * l * (ahead[0][0] + kUnmovedSigma_m * kUnmovedSigma_m);
      }
  }
  const double a = state.variance(0, 0), b = state.variance(0, 1), c = state.variance(1, 1);
  return {error[0][0] / a, error[1][1] / c,
          (c * error[0][0] - 2.0 * b * error[0][1] + a * error[1][1]) / (a * c - b * b)};
}

}  // namespace

// In continuous time a filter of order n is Butterworth's: noise of the measurement alone leaves 1 - 1/2n of the
// variance told in position, 1 - 3/2n in speed, whatever the noise expected is. So a car that keeps its speed across
// the line of sight brings the four states from 4 down to 3 in a model of white acceleration; the smoother a model
// takes it to move, the less: 3.6 for one whose turn rate has two derivatives.
TEST_CASE(
    "A target without the noise expected errs by less than told, the smoother the model the less",
    "[kalman]") {
  for (int order = 2; order <= 5; ++order) {
    CAPTURE(order);
    // A corner at 1/2 rad/s: slow beside the steps of 0.05 s.
    const Unmoved one =
        unmoved(order, std::pow(0.5, 2 * order) * kUnmovedSigma_m * kUnmovedSigma_m * kStep_s);
    const double n = order;
    CHECK(one.position == Approx(1.0 - 0.5 / n).epsilon(0.012));
    CHECK(one.speed == Approx(1.0 - 1.5 / n).epsilon(0.012));
    CHECK(one.both == Approx(2.0 - 2.0 / n).epsilon(0.012));
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
