// Models of motion against closed forms, and which of them the interacting filter believes.
#include "tracking/filters/imm.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "tests/tracking/simulated.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::kStep_s;
using tests::run_key;

namespace {

ImmModel three_models() {
  ImmModel model;
  model.motions.resize(3);
  model.motions[0].acceleration_mps2 = 0.2;
  model.motions[1].kind = MotionKind::constant_acceleration;
  model.motions[2].kind = MotionKind::smooth_turn;
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

TEST_CASE("A bend that lasts follows the circle", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.radar_velocity_mps = {3.0, -2.0};
  for (const double rate : {0.3, -0.7, 1e-3, 1e-7, 0.0}) {
    Gaussian state;
    state.size = 8;
    state.mean = {50.0, 0.0, 4.0 - 3.0, 15.0 + 2.0, 0.0, 0.0, 0.0, rate};
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
  }
}

TEST_CASE("A turn goes as its equations integrated", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  const double k = 1.0 / model.steering_time_s;
  Gaussian state;
  state.size = 8;
  state.mean = {50.0, 0.0, 4.0, 15.0, 0.3, -0.4, 1.5, 0.2};
  const double bend = 0.2;
  double x = 50.0, y = 0.0, heading = std::atan2(15.0, 4.0), w = 0.3, dw = -0.4, ddw = 1.5;
  const double speed = std::hypot(4.0, 15.0);
  constexpr double kTime_s = 0.2;
  constexpr int kSteps = 200000;
  const double h = kTime_s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    // Middle of each small step.
    const double dddw = -k * k * k * w - 3.0 * k * k * dw - 3.0 * k * ddw;
    const double w2 = w + 0.5 * h * dw, dw2 = dw + 0.5 * h * ddw, ddw2 = ddw + 0.5 * h * dddw;
    const double heading2 = heading + 0.5 * h * (bend + w);
    x += h * speed * std::cos(heading2);
    y += h * speed * std::sin(heading2);
    heading += h * (bend + w2);
    w += h * dw2;
    dw += h * ddw2;
    ddw += h * (-k * k * k * w2 - 3.0 * k * k * dw2 - 3.0 * k * ddw2);
  }
  predict(model, kTime_s, state);
  CHECK(state.mean[2] == Approx(speed * std::cos(heading)).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[3] == Approx(speed * std::sin(heading)).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[4] == Approx(w).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[5] == Approx(dw).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[6] == Approx(ddw).epsilon(0.0).margin(1e-7));
  // Evenly inside the step: w' T^3 |g| / 12.
  const double most_m = 0.4 * std::pow(kTime_s, 3) * speed / 12.0;
  CHECK(std::hypot(state.mean[0] - x, state.mean[1] - y) < 1.2 * most_m);
}

TEST_CASE("A turn's Jacobian is that of differences, in all its states", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.radar_velocity_mps = {3.0, -2.0};
  model.acceleration_mps2 = model.steering_sigma_rad_per_s = 0.0;
  model.bend_density_rad2_per_s3 = 0.0;
  for (const double rate : {0.3, 1e-7}) {
    Gaussian before;
    before.size = 8;
    before.mean = {50.0, 0.0, 1.0, 17.0, rate, -0.2 * rate, 2.0 * rate, 0.5 * rate};
    for (int of = 0; of < 8; ++of) {
      Gaussian certain = before, above = before, below = before;
      certain.variance(of, of) = 1.0;
      above.mean[static_cast<std::size_t>(of)] += 1e-5;
      below.mean[static_cast<std::size_t>(of)] -= 1e-5;
      for (Gaussian* one : {&certain, &above, &below}) predict(model, 0.3, *one);
      const auto slope = [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        return (above.mean[at] - below.mean[at]) / 2e-5;
      };
      for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column)
          CHECK(certain.variance(row, column) ==
                Approx(slope(row) * slope(column)).epsilon(1e-6).margin(1e-6));
    }
  }
}

TEST_CASE("Noise of a turn composes, and leaves its spread as it is", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.acceleration_mps2 = 0.0;
  for (const double step_s : {1e-3, 0.05, 1.0, 20.0}) {
    CAPTURE(step_s);
    Gaussian steady;
    add_turn(model, steady);
    const Gaussian before = steady;
    predict(model, step_s, steady);
    Gaussian whole, halves;
    whole.size = halves.size = 8;
    predict(model, step_s, whole);
    predict(model, 0.5 * step_s, halves);
    predict(model, 0.5 * step_s, halves);
    const auto scale = [&](const Gaussian& of, int row, int column) {
      return std::sqrt(of.variance(row, row) * of.variance(column, column));
    };
    for (int row = 4; row < 7; ++row)
      for (int column = 4; column < 7; ++column) {
        CHECK(steady.variance(row, column) == Approx(before.variance(row, column))
                                                  .epsilon(0.0)
                                                  .margin(1e-12 * scale(before, row, column)));
        CHECK(whole.variance(row, column) == Approx(halves.variance(row, column))
                                                 .epsilon(0.0)
                                                 .margin(1e-10 * scale(whole, row, column)));
      }
  }
  Gaussian bent;
  bent.size = 8;
  predict(model, 0.1, bent);
  CHECK(bent.variance(7, 7) == Approx(0.1 * model.bend_density_rad2_per_s3));
  // Within a step far below 1 / k: white noise of density q, integrated three times.
  Gaussian fresh;
  fresh.size = 8;
  predict(model, 1e-3, fresh);
  const double q = 16.0 / 3.0 * std::pow(model.steering_sigma_rad_per_s, 2) *
                   std::pow(model.steering_time_s, -5.0);
  CHECK(fresh.variance(4, 4) == Approx(q * 1e-15 / 20.0).epsilon(0.01));
  CHECK(fresh.variance(4, 6) == Approx(q * 1e-9 / 6.0).epsilon(0.01));
  CHECK(fresh.variance(6, 6) == Approx(q * 1e-3).epsilon(0.02));
}

TEST_CASE("A turning car is pushed along its way alone, a crawling one forward", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.steering_sigma_rad_per_s = model.bend_density_rad2_per_s3 = 0.0;
  model.acceleration_mps2 = 0.5;
  model.radar_velocity_mps = {20.0, 0.0};
  const auto spread = [&](double vx_mps, double vy_mps) {
    Gaussian state;
    state.size = 8;
    state.mean = {50.0, 0.0, vx_mps - 20.0, vy_mps};
    predict(model, 0.1, state);
    return state;
  };
  const Gaussian moves = spread(6.0, 8.0), stands = spread(0.1, 0.2);
  CHECK(moves.variance(2, 2) == Approx(0.36 * 0.0025));
  CHECK(moves.variance(2, 3) == Approx(0.48 * 0.0025));
  CHECK(moves.variance(3, 3) == Approx(0.64 * 0.0025));
  CHECK(moves.variance(0, 2) == Approx(0.36 * 0.25 * 5e-4));
  CHECK(stands.variance(2, 2) == Approx(0.0025));
  CHECK(stands.variance(3, 3) == 0.0);
  model.steering_time_s = 0.0;
  CHECK_THROWS_AS(spread(6.0, 8.0), core::InputError);
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
