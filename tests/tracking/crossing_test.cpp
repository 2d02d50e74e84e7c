// Probability that two tracks that met in range were exchanged.
#include "tracking/association/crossing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "tests/tracking/simulated.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::run_key;

namespace {

constexpr double kDifference_mps = 3.0 / 3.6;

// Q(x), the upper tail of the normal law.
double normal_tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

// A decision by the order of speeds, before and after each known to `sigma`.
double swap_probability(double difference_mps, double sigma_mps) {
  const double p = normal_tail(std::abs(difference_mps) / (std::sqrt(2.0) * sigma_mps));
  return 2.0 * p * (1.0 - p);
}

// Tracks at one place that know nothing but their speeds.
ImmState track(double speed_mps, double sigma_mps) {
  Gaussian state;
  state.size = 4;
  state.mean = {60.0, 0.0, speed_mps, 0.0};
  for (int i = 0; i < 4; ++i) state.variance(i, i) = i == 2 ? sigma_mps * sigma_mps : 1e-4;
  ImmModel model;
  model.motions.resize(1);
  return start_imm(model, state);
}

RadarMeasurement seen_speed(double speed_mps, double sigma_mps) {
  return {60.0, speed_mps, 0.0, 1.0, sigma_mps, 1.0};
}

}  // namespace

TEST_CASE("P(swap) at 3 km/h is that of the table", "[crossing]") {
  CHECK(swap_probability(kDifference_mps, 0.1) == Approx(3.8e-9).epsilon(0.02));
  CHECK(swap_probability(kDifference_mps, 0.2) == Approx(3.2e-3).epsilon(0.02));
  CHECK(swap_probability(kDifference_mps, 0.3) == Approx(4.83e-2).epsilon(0.01));
  CHECK(swap_probability(-kDifference_mps, 0.5) == Approx(0.210).epsilon(0.005));
}

TEST_CASE("Tracks that differ in speed alone are told apart by speed alone", "[crossing]") {
  const double sigma = 0.4, variance = 2.0 * sigma * sigma;
  for (const double after_mps : {0.7, -0.7}) {
    const double kept =
        kept_probability(track(0.5, sigma), track(-0.3, sigma), Measured::range_and_rate,
                         seen_speed(after_mps - 0.1, sigma), seen_speed(-0.1, sigma));
    CHECK(kept == Approx(kept_by_difference(0.8, variance, after_mps, variance)).epsilon(1e-9));
    CHECK((kept > 0.5) == (after_mps > 0.0));
  }
  CHECK(kept_by_difference(2.0, 1e-4, 2.0, 1e-4) == 1.0);
  CHECK(kept_by_difference(2.0, 1e-4, -2.0, 1e-4) < 1e-300);
  CHECK(kept_by_difference(0.0, 1.0, 0.0, 1.0) == 0.5);
  CHECK_THROWS_AS(kept_by_difference(1.0, 0.0, 1.0, 1.0), core::InputError);
  CHECK_THROWS_AS(kept_by_difference(1.0, 1.0, std::nan(""), 1.0), core::InputError);
}

TEST_CASE("What tells a pair apart is the axis on which it differs, and neither name comes first",
          "[crossing]") {
  // Of one speed, but 0.06 rad apart, known to 0.001.
  ImmState left = track(0.0, 0.3), right = track(0.0, 0.3);
  left.states[0].mean[1] = -1.8;
  right.states[0].mean[1] = 1.8;
  RadarMeasurement c = seen_speed(0.0, 0.3), d = c;
  c.azimuth_rad = -0.03;
  d.azimuth_rad = 0.03;
  c.azimuth_sigma_rad = d.azimuth_sigma_rad = 0.001;
  constexpr Measured kAll = Measured::range_rate_and_azimuth;
  CHECK(kept_probability(left, right, kAll, c, d) > 1.0 - 1e-12);
  CHECK(kept_probability(left, right, kAll, d, c) < 1e-12);
  // The same for range and rate alone: nothing tells them apart.
  CHECK(kept_probability(left, right, Measured::range_and_rate, c, d) == Approx(0.5));
  const ImmState slow = track(-0.2, 0.3), fast = track(0.3, 0.2);
  const double kept =
      kept_probability(slow, fast, kAll, seen_speed(-0.1, 0.3), seen_speed(0.5, 0.2));
  CHECK(kept_probability(fast, slow, kAll, seen_speed(0.5, 0.2), seen_speed(-0.1, 0.3)) ==
        Approx(kept).epsilon(1e-12));
  CHECK(kept_probability(fast, slow, kAll, seen_speed(-0.1, 0.3), seen_speed(0.5, 0.2)) ==
        Approx(1.0 - kept).epsilon(1e-9));
}

TEST_CASE("Told probabilities are those with which swaps happen", "[crossing][statistics]") {
  constexpr int kRuns = 20000;
  for (const double sigma : {0.1, 0.2, 0.3, 0.5}) {
    int swaps = 0;
    double told = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      const auto before = core::normal_pair(run_key(run, 1004), 0, 0);
      const auto after = core::normal_pair(run_key(run, 1004), 0, 1);
      const double variance = 2.0 * sigma * sigma;
      const double kept =
          kept_by_difference(kDifference_mps + sigma * (before[0] - before[1]), variance,
                             kDifference_mps + sigma * (after[0] - after[1]), variance);
      swaps += kept < 0.5;
      told += std::min(kept, 1.0 - kept) / kRuns;
    }
    const double rate = static_cast<double>(swaps) / kRuns;
    INFO("sigma " << sigma << ": rate " << rate << ", told " << told);
    CHECK(rate == Approx(swap_probability(kDifference_mps, sigma)).epsilon(0.0).margin(0.012));
    CHECK(told == Approx(rate).epsilon(0.0).margin(0.03));
    CHECK(told == Approx(swap_probability(kDifference_mps, sigma)).epsilon(0.0).margin(0.03));
  }
}
