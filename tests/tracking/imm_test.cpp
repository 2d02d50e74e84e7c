// Models of motion against closed forms, and which of them the interacting filter believes.
#include "tracking/filters/imm.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "tests/tracking/simulated.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::run_key;

namespace {

constexpr double kStep_s = 0.05;

ImmModel three_models() {
  ImmModel model;
  model.motions.resize(3);
  model.motions[0].acceleration_mps2 = 0.2;
  model.motions[1].kind = MotionKind::constant_acceleration;
  model.motions[2].kind = MotionKind::coordinated_turn;
  model.motions[2].acceleration_mps2 = 0.2;
  return model;
}

RadarMeasurement measured(const StateVector& truth, const core::RandomKey& key, int step) {
  const auto n = core::normal_pair(key, static_cast<std::uint64_t>(step), 1);
  const auto n2 = core::normal_pair(key, static_cast<std::uint64_t>(step), 2);
  const double range_m = std::hypot(truth[0], truth[1]);
  return {range_m + 0.02 * n[0],
          (truth[0] * truth[2] + truth[1] * truth[3]) / range_m + 0.02 * n[1],
          std::atan2(truth[1], truth[0]) + 0.001 * n2[0],
          0.02,
          0.02,
          0.001};
}

Gaussian start_of(const StateVector& truth) {
  Gaussian state;
  state.size = 4;
  state.mean = truth;
  for (int i = 0; i < 4; ++i) state.variance(i, i) = i < 2 ? 0.01 : 1.0;
  return state;
}

}  // namespace

TEST_CASE("A coordinated turn follows the circle, its Jacobian the differences", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::coordinated_turn;
  model.radar_velocity_mps = {3.0, -2.0};
  for (const double rate : {0.3, -0.7, 1e-3, 1e-7, 0.0}) {
    Gaussian state;
    state.size = 5;
    state.mean = {50.0, 0.0, 4.0 - 3.0, 15.0 + 2.0, rate};
    const Gaussian before = state;
    predict(model, 0.5, state);
    // 1000 steps of a circle's chords.
    double x = 50.0, y = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double angle = rate * (i + 0.5) * 5e-4;
      x += (4.0 * std::cos(angle) - 15.0 * std::sin(angle) - 3.0) * 5e-4;
      y += (4.0 * std::sin(angle) + 15.0 * std::cos(angle) + 2.0) * 5e-4;
    }
    CHECK(state.mean[0] == Approx(x).epsilon(0.0).margin(1e-6));
    CHECK(state.mean[1] == Approx(y).epsilon(0.0).margin(1e-6));
    CHECK(std::hypot(state.mean[2] + 3.0, state.mean[3] - 2.0) ==
          Approx(std::hypot(4.0, 15.0)).epsilon(1e-12));
    // A variance of the turn rate alone moves along d(state)/d(rate).
    Gaussian certain = before;
    certain.variance(4, 4) = 1.0;
    model.acceleration_mps2 = model.turn_density_rad2_per_s3 = 0.0;
    predict(model, 0.5, certain);
    Gaussian above = before, below = before;
    above.mean[4] += 1e-5;
    below.mean[4] -= 1e-5;
    predict(model, 0.5, above);
    predict(model, 0.5, below);
    for (int i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(i);
      CHECK(certain.variance(i, 4) ==
            Approx((above.mean[k] - below.mean[k]) / 2e-5).epsilon(0.0).margin(1e-5));
    }
  }
}

TEST_CASE("Noise of constant acceleration composes: two halves make one step", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::constant_acceleration;
  Gaussian whole, halves;
  whole.size = halves.size = 6;
  predict(model, 0.8, whole);
  predict(model, 0.4, halves);
  predict(model, 0.4, halves);
  for (std::size_t i = 0; i < whole.covariance.size(); ++i)
    CHECK(whole.covariance[i] == Approx(halves.covariance[i]).epsilon(1e-12));
  CHECK(whole.variance(0, 0) == Approx(std::pow(0.8, 5) / 20).epsilon(1e-12));
}

TEST_CASE("Moments of a mixture hold the spread of its means", "[imm]") {
  Gaussian a, b;
  a.size = b.size = 1;
  a.mean[0] = -1.0;
  b.mean[0] = 3.0;
  a.variance(0, 0) = b.variance(0, 0) = 0.5;
  const Gaussian both = moments({{1.0, a}, {3.0, b}});
  CHECK(both.mean[0] == Approx(2.0));
  CHECK(both.variance(0, 0) == Approx(0.5 + 0.25 * 9.0 + 0.75 * 1.0));
  CHECK_THROWS_AS(moments({{0.0, a}}), core::InputError);
}

TEST_CASE("A single model is the extended filter itself", "[imm]") {
  ImmModel model;
  model.motions.resize(1);
  const StateVector truth = {50.0, 5.0, 1.0, 2.0};
  Gaussian plain = start_of(truth);
  ImmState state = start_imm(model, plain);
  for (int step = 1; step < 20; ++step) {
    const RadarMeasurement z = measured(truth, run_key(3), step);
    predict(model, kStep_s, state);
    predict(model.motions[0], kStep_s, plain);
    const Update told = update(state, Measured::range_rate_and_azimuth, z);
    const Update direct = update(plain, observe(plain, 2, Measured::range_rate_and_azimuth, z));
    CHECK(told.log_likelihood == Approx(direct.log_likelihood));
  }
  CHECK(state.states[0] == plain);
}

TEST_CASE("The filter of three models believes the right one and errs less than a straight one",
          "[imm][statistics]") {
  // 2 s straight on, 2 s braking with 6 m/s2, 2 s straight, 2 s turning with 0.5 rad/s.
  const ImmModel model = three_models();
  ImmModel straight;
  straight.motions.push_back(model.motions[0]);
  double square_imm = 0.0, square_straight = 0.0;
  constexpr int kRuns = 30;
  std::array<double, 3> belief_braking{}, belief_turning{}, belief_straight{};
  for (int run = 0; run < kRuns; ++run) {
    StateVector truth = {40.0, -20.0, 10.0, 12.0};
    ImmState state = start_imm(model, start_of(truth)),
             plain = start_imm(straight, start_of(truth));
    for (int step = 1; step <= 160; ++step) {
      const double t_s = step * kStep_s;
      const double speed = std::hypot(truth[2], truth[3]);
      double ax = 0.0, ay = 0.0;
      if (t_s > 2.0 && t_s <= 4.0) ax = -3.0 * truth[2] / speed, ay = -3.0 * truth[3] / speed;
      if (t_s > 6.0) ax = -0.5 * truth[3], ay = 0.5 * truth[2];
      truth[0] += truth[2] * kStep_s + 0.5 * ax * kStep_s * kStep_s;
      truth[1] += truth[3] * kStep_s + 0.5 * ay * kStep_s * kStep_s;
      truth[2] += ax * kStep_s;
      truth[3] += ay * kStep_s;
      const RadarMeasurement z = measured(truth, run_key(run, 1002), step);
      for (auto* one : {&state, &plain}) {
        predict(one == &state ? model : straight, kStep_s, *one);
        REQUIRE(update(*one, Measured::range_rate_and_azimuth, z).applied);
      }
      const Gaussian a = combined(state), b = combined(plain);
      for (std::size_t i = 2; i < 4; ++i) {
        square_imm += std::pow(a.mean[i] - truth[i], 2);
        square_straight += std::pow(b.mean[i] - truth[i], 2);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        if (step == 38) belief_straight[i] += state.probabilities[i] / kRuns;
        if (step == 78) belief_braking[i] += state.probabilities[i] / kRuns;
        if (step == 158) belief_turning[i] += state.probabilities[i] / kRuns;
      }
    }
  }
  INFO("straight " << belief_straight[0] << ", braking " << belief_braking[1] << ", turning "
                   << belief_turning[2] << ", squared errors " << square_imm << " and "
                   << square_straight);
  CHECK(belief_straight[0] == *std::max_element(belief_straight.begin(), belief_straight.end()));
  CHECK(belief_braking[1] == *std::max_element(belief_braking.begin(), belief_braking.end()));
  CHECK(belief_turning[2] == *std::max_element(belief_turning.begin(), belief_turning.end()));
  CHECK(square_imm < 0.5 * square_straight);
}
