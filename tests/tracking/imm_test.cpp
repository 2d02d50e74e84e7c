// Models of motion against closed forms, and which of them the interacting filter believes.
#include "tracking/filters/imm.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

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
  model.motions[2].steering_sigma_rad_per_s = 0.3;
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
    state.size = 11;
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

namespace {

// (d/dt + k)^3 f = 0, by the middle of small steps.
struct Smooth {
  double k, f, df, ddf;
  void go(double h) {
    const auto third = [this](double a, double b, double c) {
      return -k * k * k * a - 3.0 * k * k * b - 3.0 * k * c;
    };
    const double f2 = f + 0.5 * h * df, df2 = df + 0.5 * h * ddf;
    const double ddf2 = ddf + 0.5 * h * third(f, df, ddf);
    f += h * df2;
    df += h * ddf2;
    ddf += h * third(f2, df2, ddf2);
  }
};

}  // namespace

TEST_CASE("A turn goes as its equations integrated", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.along_time_s = 0.5;
  Gaussian state;
  state.size = 11;
  state.mean = {50.0, 0.0, 4.0, 15.0, 0.3, -0.4, 1.5, 0.2, 0.6, -2.0, 3.0};
  const double bend = 0.2;
  Smooth turn{1.0 / model.steering_time_s, 0.3, -0.4, 1.5}, push{2.0, 0.6, -2.0, 3.0};
  double x = 50.0, y = 0.0, heading = std::atan2(15.0, 4.0), speed = std::hypot(4.0, 15.0);
  const double first_mps = speed;
  constexpr double kTime_s = 0.2;
  constexpr int kSteps = 200000;
  const double h = kTime_s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double heading2 = heading + 0.5 * h * (bend + turn.f), speed2 = speed + 0.5 * h * push.f;
    x += h * speed2 * std::cos(heading2);
    y += h * speed2 * std::sin(heading2);
    heading += h * (bend + turn.f + 0.5 * h * turn.df);
    speed += h * (push.f + 0.5 * h * push.df);
    turn.go(h);
    push.go(h);
  }
  predict(model, kTime_s, state);
  CHECK(state.mean[2] == Approx(speed * std::cos(heading)).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[3] == Approx(speed * std::sin(heading)).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[4] == Approx(turn.f).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[5] == Approx(turn.df).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[6] == Approx(turn.ddf).epsilon(0.0).margin(1e-7));
  CHECK(state.mean[8] == Approx(push.f).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[9] == Approx(push.df).epsilon(0.0).margin(1e-8));
  CHECK(state.mean[10] == Approx(push.ddf).epsilon(0.0).margin(1e-7));
  // Evenly inside the step: w' T^3 |g| / 12.
  const double most_m = 0.4 * std::pow(kTime_s, 3) * first_mps / 12.0;
  CHECK(std::hypot(state.mean[0] - x, state.mean[1] - y) < 1.2 * most_m);
  CHECK(std::abs(speed - first_mps) * kTime_s > 3.0 * most_m);  // what it would be off by without
}

TEST_CASE("A turn's Jacobian is that of differences, in all its states", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.radar_velocity_mps = {3.0, -2.0};
  model.along_sigma_mps2 = model.steering_sigma_rad_per_s = 0.0;
  model.bend_density_rad2_per_s3 = 0.0;
  for (const double rate : {0.3, 1e-7}) {
    Gaussian before;
    before.size = 11;
    before.mean = {50.0, 0.0, 1.0, 17.0, rate, -0.2 * rate, 2.0 * rate, 0.5 * rate, 0.7, -0.9, 1.3};
    for (int of = 0; of < 11; ++of) {
      // So little that the velocity is known.
      constexpr double kVariance = 1e-6;
      Gaussian certain = before, above = before, below = before;
      certain.variance(of, of) = kVariance;
      above.mean[static_cast<std::size_t>(of)] += 1e-5;
      below.mean[static_cast<std::size_t>(of)] -= 1e-5;
      for (Gaussian* one : {&certain, &above, &below}) predict(model, 0.3, *one);
      const auto slope = [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        return (above.mean[at] - below.mean[at]) / 2e-5;
      };
      for (int row = 0; row < 11; ++row)
        for (int column = 0; column < 11; ++column)
          CHECK(certain.variance(row, column) / kVariance ==
                Approx(slope(row) * slope(column)).epsilon(1e-6).margin(1e-6));
    }
  }
}

TEST_CASE("Noise of a turn composes, and leaves its spread as it is", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.along_time_s = 0.7;
  for (const double step_s : {1e-3, 0.05, 1.0, 20.0}) {
    CAPTURE(step_s);
    Gaussian steady;
    add_turn(model, steady);
    const Gaussian before = steady;
    predict(model, step_s, steady);
    Gaussian whole, halves;
    whole.size = halves.size = 11;
    predict(model, step_s, whole);
    predict(model, 0.5 * step_s, halves);
    predict(model, 0.5 * step_s, halves);
    const auto scale = [&](const Gaussian& of, int row, int column) {
      return std::sqrt(of.variance(row, row) * of.variance(column, column));
    };
    for (const int first : {4, 8})
      for (int row = first; row < first + 3; ++row)
        for (int column = first; column < first + 3; ++column) {
          CHECK(steady.variance(row, column) == Approx(before.variance(row, column))
                                                    .epsilon(0.0)
                                                    .margin(1e-12 * scale(before, row, column)));
          CHECK(whole.variance(row, column) == Approx(halves.variance(row, column))
                                                   .epsilon(0.0)
                                                   .margin(1e-10 * scale(whole, row, column)));
        }
  }
  Gaussian bent;
  bent.size = 11;
  predict(model, 0.1, bent);
  CHECK(bent.variance(7, 7) == Approx(0.1 * model.bend_density_rad2_per_s3));
  // Within a step far below 1 / k: white noise of density q, integrated three times.
  Gaussian fresh;
  fresh.size = 11;
  predict(model, 1e-3, fresh);
  const auto check_fresh = [&](int at, double sigma, double time_s) {
    const double q = 16.0 / 3.0 * sigma * sigma * std::pow(time_s, -5.0);
    CHECK(fresh.variance(at, at) == Approx(q * 1e-15 / 20.0).epsilon(0.01));
    CHECK(fresh.variance(at, at + 2) == Approx(q * 1e-9 / 6.0).epsilon(0.01));
    CHECK(fresh.variance(at + 2, at + 2) == Approx(q * 1e-3).epsilon(0.02));
  };
  check_fresh(4, model.steering_sigma_rad_per_s, model.steering_time_s);
  check_fresh(8, model.along_sigma_mps2, model.along_time_s);
}

TEST_CASE("A turning car is pushed along its way alone, a crawling one forward", "[imm]") {
  MotionModel model;
  model.kind = MotionKind::smooth_turn;
  model.steering_sigma_rad_per_s = model.bend_density_rad2_per_s3 = model.along_sigma_mps2 = 0.0;
  model.along_time_s = 1e3;  // as good as constant
  model.radar_velocity_mps = {20.0, 0.0};
  const auto predicted = [&](double vx_mps, double vy_mps, int of, double variance) {
    Gaussian state;
    state.size = 11;
    state.mean = {50.0, 0.0, vx_mps - 20.0, vy_mps};
    state.variance(of, of) = variance;
    predict(model, 0.1, state);
    return state;
  };
  const auto spread = [&](double vx_mps, double vy_mps) {
    return predicted(vx_mps, vy_mps, 8, 0.25);
  };
  const Gaussian moves = spread(6.0, 8.0), stands = spread(0.1, 0.2);
  CHECK(moves.variance(2, 2) == Approx(0.36 * 0.0025));
  CHECK(moves.variance(2, 3) == Approx(0.48 * 0.0025));
  CHECK(moves.variance(3, 3) == Approx(0.64 * 0.0025));
  CHECK(moves.variance(0, 2) == Approx(0.36 * 0.25 * 5e-4));
  CHECK(stands.variance(2, 2) == Approx(0.0025));
  CHECK(stands.variance(3, 3) == 0.0);
  // Along the way, too, as long as it is not known: 1.5 m/s of 10, then of 2.
  model.acceleration_mps2 = 0.7;
  const auto unknown = [&](double vx_mps, double vy_mps) {
    return predicted(vx_mps, vy_mps, 3, 2.25).variance(2, 2);
  };
  CHECK(unknown(6.0, 8.0) == Approx(0.0).epsilon(0.0).margin(1e-12));
  CHECK(unknown(1.2, 1.6) == Approx(0.36 * 0.0049));
  for (double* time_s : {&model.steering_time_s, &model.along_time_s}) {
    *time_s = 0.0;
    CHECK_THROWS_AS(spread(6.0, 8.0), core::InputError);
    *time_s = 1.0;
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
      // A turn keeps the speed.
      const std::complex<double> turn = std::polar(1.0, t_s > 6.0 ? 0.5 * kStep_s : 0.0);
      const std::complex<double> before(truth[2], truth[3]), after = turn * before;
      const std::complex<double> moved = 0.5 * kStep_s * (before + after);
      truth[0] += moved.real() + 0.5 * ax * kStep_s * kStep_s;
      truth[1] += moved.imag() + 0.5 * ay * kStep_s * kStep_s;
      truth[2] = after.real() + ax * kStep_s;
      truth[3] = after.imag() + ay * kStep_s;
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
