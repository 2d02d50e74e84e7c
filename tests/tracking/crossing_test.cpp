// Probability that two tracks that met in range were exchanged.
#include "tracking/association/crossing.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"

using namespace fanbeam;
using namespace fanbeam::tracking;

namespace {

constexpr double kDifference_mps = 3.0 / 3.6;

struct Swaps {
  double rate = 0.0;  // of decisions that are wrong
  double told = 0.0;  // how likely they were said to be wrong, on average
};

// Over all errors of speeds that are known to `sigma`, before and after: midpoints of cells of a fortieth of a
// deviation, which no decision divides.
Swaps swaps(double difference_mps, double sigma_mps) {
  const double deviation_mps = std::sqrt(2.0) * sigma_mps, cell_mps = deviation_mps / 40.0;
  const double variance = deviation_mps * deviation_mps;
  std::vector<std::array<double, 2>> seen;  // and how likely
  for (int i = -800; i < 800; ++i) {
    const double at_mps = (i + 0.5) * cell_mps;
    const double error = (at_mps - difference_mps) / deviation_mps;
    if (std::abs(error) < 9.0)
      seen.push_back({at_mps, std::exp(-0.5 * error * error) / std::sqrt(2.0 * core::kPi) / 40.0});
  }
  Swaps sum;
  for (const auto& [before_mps, before_share] : seen)
    for (const auto& [after_mps, after_share] : seen) {
      const double kept = kept_by_difference(before_mps, variance, after_mps, variance);
      sum.rate += kept < 0.5 ? before_share * after_share : 0.0;
      sum.told += std::min(kept, 1.0 - kept) * before_share * after_share;
    }
  return sum;
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

// The rates are 2 p (1 - p). What is told is, by a quadrature of the formulas of crossing.h that is none of ours, more
// than they where swaps are rare; within 0.02 of them, as said there.
TEST_CASE("At 3 km/h swaps happen as the table says, and are told as the formulas say",
          "[crossing]") {
  struct Row {
    double sigma_mps, rate, rate_error, told;
  };
  for (const Row& row : {Row{0.1, 3.8e-9, 0.02, 9.925e-9}, Row{0.2, 3.2e-3, 0.02, 6.485e-3},
                         Row{0.3, 4.83e-2, 0.01, 6.820e-2}, Row{0.5, 0.210, 0.005, 0.20372}})
    for (const double sign : {1.0, -1.0}) {
      const Swaps found = swaps(sign * kDifference_mps, row.sigma_mps);
      INFO(row.sigma_mps << " m/s: rate " << found.rate << ", told " << found.told);
      CHECK(found.rate == Approx(row.rate).epsilon(row.rate_error));
      CHECK(found.told == Approx(row.told).epsilon(3e-3));
      CHECK(found.told == Approx(found.rate).epsilon(0.0).margin(0.02));
    }
}

TEST_CASE("Tracks that differ in speed alone are told apart by speed alone", "[crossing]") {
  // By the formulas of crossing.h, u = 0.8 and w = +-0.7 with variances 2 sigma^2: D^2 = (u^2 + w^2) / 2.
  const double sigma = 0.4;
  for (const auto& [after_mps, expected] : {std::pair{0.7, 0.9428815538}, {-0.7, 0.0571184462}})
    CHECK(kept_probability(track(0.5, sigma), track(-0.3, sigma), Measured::range_and_rate,
                           seen_speed(after_mps - 0.1, sigma),
                           seen_speed(-0.1, sigma)) == Approx(expected).epsilon(1e-8));
  // Of unlike variances.
  CHECK(kept_by_difference(0.8, 0.5, 0.6, 0.1) == Approx(0.8846343107).epsilon(1e-8));
  CHECK(kept_by_difference(0.8, 0.5, -0.2, 0.1) == Approx(0.3300157259).epsilon(1e-8));
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
