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

RadarMeasurement seen(double speed_mps, double sigma_mps) {
  return {60.0, speed_mps, 0.0, 1.0, sigma_mps, 1.0};
}

}  // namespace

TEST_CASE("P(swap) at 3 km/h is that of the table", "[crossing]") {
  CHECK(swap_probability(kDifference_mps, 0.1) == Approx(3.8e-9).epsilon(0.02));
  CHECK(swap_probability(kDifference_mps, 0.2) == Approx(3.2e-3).epsilon(0.02));
  CHECK(swap_probability(kDifference_mps, 0.3) == Approx(4.83e-2).epsilon(0.01));
  CHECK(swap_probability(-kDifference_mps, 0.5) == Approx(0.210).epsilon(0.005));
  CHECK_THROWS_AS(swap_probability(1.0, 0.0), core::InputError);
}

TEST_CASE("Hypotheses of speed alone have the closed odds", "[crossing]") {
  const double sigma = 0.4;
  const double kept =
      kept_probability(track(0.5, sigma), track(-0.3, sigma), Measured::range_and_rate,
                       seen(0.6, sigma), seen(-0.1, sigma));
  const double odds = std::exp(0.8 * 0.7 / (2.0 * sigma * sigma));
  CHECK(kept == Approx(odds / (1.0 + odds)).epsilon(1e-9));
  CHECK(kept_probability(-HUGE_VAL, -HUGE_VAL, 0.7) == 0.7);
  CHECK(kept_probability(-1e6, 0.0) == 0.0);
  CHECK(kept_probability(0.0, -1e6) == 1.0);
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
      const double kept = kept_by_speed(kDifference_mps + sigma * (before[0] - before[1]), variance,
                                        kDifference_mps + sigma * (after[0] - after[1]), variance);
      swaps += kept < 0.5;
      told += std::min(kept, 1.0 - kept) / kRuns;
    }
    const double rate = static_cast<double>(swaps) / kRuns;
    INFO("sigma " << sigma << ": rate " << rate << ", told " << told);
    CHECK(rate == Approx(swap_probability(kDifference_mps, sigma)).margin(0.012));
    CHECK(told == Approx(rate).margin(0.03));
    CHECK(told == Approx(swap_probability(kDifference_mps, sigma)).margin(0.03));
  }
}

TEST_CASE("Among decisions told with the same probability that part is right",
          "[crossing][statistics]") {
  // Speeds differ by a random amount: the calibration over a flat prior.
  constexpr int kRuns = 40000;
  double right[5] = {}, count[5] = {}, told[5] = {};
  for (int run = 0; run < kRuns; ++run) {
    const auto key = run_key(run, 1005);
    const double difference = 6.0 * (core::uniform_from(core::random_words(key, 1, 0)[0]) - 0.5);
    const auto before = core::normal_pair(key, 0, 0), after = core::normal_pair(key, 0, 1);
    const double kept =
        kept_probability(track(difference + 0.3 * before[0], 0.3), track(0.3 * before[1], 0.3),
                         Measured::range_and_rate, seen(difference + 0.3 * after[0], 0.3),
                         seen(0.3 * after[1], 0.3));
    const int bin = std::min(4, static_cast<int>(10.0 * (std::max(kept, 1.0 - kept) - 0.5)));
    ++count[bin];
    told[bin] += std::max(kept, 1.0 - kept);
    right[bin] += kept > 0.5;
  }
  for (int bin = 0; bin < 5; ++bin) {
    INFO("bin " << bin << " of " << count[bin]);
    const double sigma = 0.5 / std::sqrt(count[bin]);
    CHECK(right[bin] / count[bin] == Approx(told[bin] / count[bin]).margin(4.0 * sigma));
  }
}
