// K06: filters are as good as they say, over fixed runs with matched noise.
#include <catch2/catch.hpp>
#include <cmath>

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
    errors += squared_distance(state, {position_m, speed_mps}) / kRuns;
  }
  CHECK(mean_interval(2, kRuns).contains(innovations));
  CHECK(mean_interval(2, kRuns).contains(errors));
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
    errors += squared_distance(state, truth) / kRuns;
  }
  CHECK(mean_interval(3, kRuns).contains(innovations));
  CHECK(mean_interval(4, kRuns).contains(errors));
}
