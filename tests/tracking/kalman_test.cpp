// Hard cases K01 to K05, steady gains of closed form, gates.
#include "tracking/filters/kalman.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "core/constants.h"
#include "core/errors.h"
#include "tests/tracking/simulated.h"
#include "tracking/filters/chi_square.h"
#include "tracking/filters/motion.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::kStep_s;
using tests::line;
using tests::line_state;
using tests::seen;

namespace {

Observation scalar(double value, double predicted, double variance) {
  Observation one;
  one.size = 1;
  one.value[0] = value;
  one.residual[0] = value - predicted;
  one.noise[0] = variance;
  one.jacobian[0] = 1.0;
  return one;
}

// Steady state of a filter of constant velocity that measures position alone. L = sa T^2 / sR,
//   r = (4 + L - sqrt(8 L + L^2)) / 4, alpha = 1 - r^2, beta = 2 (2 - alpha) - 4 sqrt(1 - alpha)
// (P. R. Kalata, "The tracking index", IEEE Trans. AES-20, 1984).
struct AlphaBeta {
  double alpha = 0.0, beta = 0.0;
};
AlphaBeta steady_alpha_beta(double index) {
  const double root = (4.0 + index - std::sqrt(8.0 * index + index * index)) / 4.0;
  const double alpha = 1.0 - root * root;
  return {alpha, 2.0 * (2.0 - alpha) - 4.0 * root};
}

Update steady(Measured measured, double range_sigma_m, double rate_sigma_mps, Gaussian& state) {
  state = line_state(10.0, 10.0);
  Update last;
  for (int i = 0; i < 4000; ++i) {
    predict(line(), kStep_s, state);
    last = update(state, observe(state, 1, measured, seen(0, 0, range_sigma_m, rate_sigma_mps)));
  }
  return last;
}

double gain(const Update& told, int row, int column) {
  return told.gain[static_cast<std::size_t>(row * kMostStates + column)];
}

bool refuses(core::ErrorClass expected, const std::function<void()>& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.has(expected);
  }
  return false;
}

}  // namespace

TEST_CASE("K01 a superb measurement keeps its variance where the prior is poor", "[kalman]") {
  Gaussian state;
  state.size = 1;
  state.variance(0, 0) = 1e10;
  REQUIRE(update(state, scalar(3.0, 0.0, 1e-8)).applied);
  CHECK(state.variance(0, 0) == Approx(1e-8).epsilon(1e-6));
  CHECK(state.mean[0] == Approx(3.0));
}

TEST_CASE("K02 a million updates leave the covariance symmetric and positive", "[kalman]") {
  // Position, velocity and attitude error of one axis; the attitude tilts gravity into velocity.
  constexpr double kGravity_mps2 = 9.81, kFrame_s = 1.0 / 16.0;
  Gaussian state;
  state.size = 3;
  for (int i = 0; i < 3; ++i) state.variance(i, i) = i == 2 ? 1e-2 : 1e6;
  double least_determinant = 1.0, most_asymmetry = 0.0;
  for (int step = 0; step < 1000000; ++step) {
    // P = F P F^T + Q by hand: the filter's own models know no attitude.
    const double f[3][3] = {{1, kFrame_s, 0}, {0, 1, kGravity_mps2 * kFrame_s}, {0, 0, 1}};
    double moved[3][3] = {}, next[3][3] = {};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k) moved[r][c] += f[r][k] * state.variance(k, c);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k) next[r][c] += moved[r][k] * f[c][k];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        state.variance(r, c) = 0.5 * (next[r][c] + next[c][r]) + (r == c ? 1e-10 : 0.0);
    Observation one;
    one.size = 1 + step % 2;  // sees one component, then two
    one.noise = {1e-4, 1e-6, 0.0};
    one.jacobian[static_cast<std::size_t>(step % 3)] = 1.0;
    one.jacobian[static_cast<std::size_t>(kMostStates + (step + 1) % 3)] = 1.0;
    REQUIRE(update(state, one).applied);
    const double trace = state.variance(0, 0) + state.variance(1, 1) + state.variance(2, 2);
    const auto p = [&](int r, int c) { return state.variance(r, c) / trace; };
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < r; ++c)
        most_asymmetry = std::max(most_asymmetry, std::abs(p(r, c) - p(c, r)));
    // All principal minors: non-negative exactly where no eigenvalue is negative.
    for (const double minor :
         {p(0, 0), p(1, 1), p(2, 2), p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0),
          p(0, 0) * p(2, 2) - p(0, 2) * p(2, 0), p(1, 1) * p(2, 2) - p(1, 2) * p(2, 1),
          p(0, 0) * (p(1, 1) * p(2, 2) - p(1, 2) * p(2, 1)) -
              p(0, 1) * (p(1, 0) * p(2, 2) - p(1, 2) * p(2, 0)) +
              p(0, 2) * (p(1, 0) * p(2, 1) - p(1, 1) * p(2, 0))})
      least_determinant = std::min(least_determinant, minor);
    if (!std::isfinite(trace)) FAIL("not finite after " << step);
  }
  CHECK(most_asymmetry <= 1e-12);
  CHECK(least_determinant >= -1e-12);
}

TEST_CASE("K03 steps of zero, back, tiny and huge", "[kalman]") {
  for (const MotionKind kind : {MotionKind::constant_velocity, MotionKind::constant_acceleration,
                                MotionKind::smooth_turn}) {
    MotionModel model;
    model.kind = kind;
    Gaussian state;
    state.size = states(model);
    for (int i = 0; i < state.size; ++i) {
      state.mean[static_cast<std::size_t>(i)] = 1.0 + i;
      state.variance(i, i) = 1.0 + i;
    }
    const Gaussian before = state;
    predict(model, 0.0, state);
    CHECK(state == before);
    CHECK(refuses(core::ErrorClass::time, [&] { predict(model, -0.1, state); }));
    CHECK(refuses(core::ErrorClass::nonfinite,
                  [&] { predict(model, std::numeric_limits<double>::quiet_NaN(), state); }));
    CHECK(state == before);
    predict(model, 1e-12, state);
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(state.mean[i] == Approx(before.mean[i]).epsilon(1e-9));
    predict(model, 1e6, state);
    for (const double value : state.covariance) CHECK(std::isfinite(value));
    for (int i = 0; i < state.size; ++i) CHECK(state.variance(i, i) > 0.0);
  }
}

TEST_CASE("K03 two measurements of one time give the same in either order", "[kalman]") {
  const RadarMeasurement first = seen(10.2, 1.1, 0.5, 0.3), second = seen(9.7, 0.8, 0.2, 0.9);
  Gaussian one = line_state(3.0, 2.0), other = one;
  for (const auto& z : {first, second}) update(one, observe(one, 1, Measured::range_and_rate, z));
  for (const auto& z : {second, first}) {
    predict(line(), 0.0, other);
    update(other, observe(other, 1, Measured::range_and_rate, z));
  }
  for (std::size_t i = 0; i < 2; ++i) CHECK(one.mean[i] == Approx(other.mean[i]).epsilon(1e-9));
  for (std::size_t i = 0; i < one.covariance.size(); ++i)
    CHECK(one.covariance[i] == Approx(other.covariance[i]).epsilon(1e-9));
}

TEST_CASE("K04 impossible measurements leave the state alone", "[kalman]") {
  Gaussian state = line_state(1.0, 1.0);
  const Gaussian before = state;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(refuses(core::ErrorClass::nonfinite, [&] {
      update(state, observe(state, 1, Measured::range_and_rate, seen(1.0, bad, 0.1, 0.1)));
    }));
    CHECK(refuses(core::ErrorClass::nonfinite, [&] {
      update(state, observe(state, 1, Measured::range_and_rate, seen(1.0, 1.0, bad, 0.1)));
    }));
  }
  CHECK(refuses(core::ErrorClass::range, [&] {
    update(state, observe(state, 1, Measured::range_and_rate, seen(1.0, 1.0, -0.1, 0.1)));
  }));
  CHECK(refuses(core::ErrorClass::range, [&] { update(state, scalar(1.0, 0.0, -1.0)); }));
  CHECK(state == before);
}

TEST_CASE("K04 a second measurement without noise is a counted skip", "[kalman]") {
  for (const Measured measured : {Measured::range, Measured::range_and_rate}) {
    Gaussian state = line_state(3.0, 2.0);
    state.variance(0, 1) = state.variance(1, 0) = 1.7;
    const RadarMeasurement exact = seen(100.0, -27.0, 0.0, 0.0);
    REQUIRE(update(state, observe(state, 1, measured, exact)).applied);
    const Gaussian after = state;
    CHECK_FALSE(update(state, observe(state, 1, measured, exact)).applied);
    CHECK(state == after);
  }
}

TEST_CASE("K05 a bearing across the border differs by 0.2 degrees", "[kalman]") {
  constexpr double kDegree = core::kPi / 180.0;
  Gaussian state;
  state.size = 4;
  state.mean = {50.0 * std::cos(179.9 * kDegree), 50.0 * std::sin(179.9 * kDegree), 0, 0, 0, 0};
  RadarMeasurement behind = seen(50.0, 0.0, 0.1, 0.1);
  behind.azimuth_rad = -179.9 * kDegree;
  const Observation one = observe(state, 2, Measured::range_rate_and_azimuth, behind);
  CHECK(one.residual[2] / kDegree == Approx(0.2).epsilon(0.0).margin(1e-9));
}

TEST_CASE("A state at the radar is told by nothing, one 2 mm away by its place", "[kalman]") {
  Gaussian state;
  state.size = 4;
  state.mean = {0.0, 0.0, -10.0, 1.0};
  for (int i = 0; i < 4; ++i) state.variance(i, i) = 0.01;
  const auto seen_here = [&] {
    return observe(state, 2, Measured::range_rate_and_azimuth, seen(5.0, -10.0, 0.1, 0.1));
  };
  const Gaussian before = state;
  update(state, seen_here());
  CHECK(std::hypot(state.mean[0] - before.mean[0], state.mean[1] - before.mean[1]) < 0.05);
  for (int i = 0; i < 4; ++i) CHECK(std::isfinite(state.mean[static_cast<std::size_t>(i)]));
  state = before;
  state.mean[0] = 0.0012;
  state.mean[1] = 0.0016;
  const Observation near = seen_here();
  CHECK(near.jacobian[0] == Approx(0.6));
  CHECK(near.jacobian[1] == Approx(0.8));
  CHECK(near.residual[2] == Approx(-std::atan2(4.0, 3.0)));
}

TEST_CASE("Gains tend to those of alpha-beta filters", "[kalman]") {
  // T 0.05 s, sa 1 m/s2, sR 0.02 m: tracking index 0.125.
  const AlphaBeta closed = steady_alpha_beta(0.125);
  CHECK(closed.alpha == Approx(0.392685).epsilon(0.0).margin(1e-6));
  CHECK(closed.beta / kStep_s == Approx(1.948261).epsilon(0.0).margin(1e-6));
  Gaussian state;
  const Update told = steady(Measured::range, 0.02, 0.0, state);
  CHECK(gain(told, 0, 0) == Approx(closed.alpha).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 1, 0) == Approx(closed.beta / kStep_s).epsilon(0.0).margin(1e-6));
}

TEST_CASE("Gains of range and range rate together tend to the published ones", "[kalman]") {
  Gaussian state;
  Update told = steady(Measured::range_and_rate, 0.02, 0.02, state);
  CHECK(gain(told, 0, 0) == Approx(0.048116).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 0, 1) == Approx(0.026544).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 1, 0) == Approx(0.026544).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 1, 1) == Approx(0.876201).epsilon(0.0).margin(1e-6));
  CHECK(std::sqrt(state.variance(0, 0)) == Approx(4.387e-3).epsilon(0.0).margin(1e-6));
  CHECK(std::sqrt(state.variance(1, 1)) == Approx(18.72e-3).epsilon(0.0).margin(1e-5));
  told = steady(Measured::range_and_rate, 0.1, 0.1, state);
  CHECK(gain(told, 0, 0) == Approx(0.047770).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 0, 1) == Approx(0.035621).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 1, 0) == Approx(0.035621).epsilon(0.0).margin(1e-6));
  CHECK(gain(told, 1, 1) == Approx(0.388266).epsilon(0.0).margin(1e-6));
  CHECK(std::sqrt(state.variance(0, 0)) == Approx(21.86e-3).epsilon(0.0).margin(1e-5));
  CHECK(std::sqrt(state.variance(1, 1)) == Approx(62.31e-3).epsilon(0.0).margin(1e-5));
}

TEST_CASE("Gates and intervals are those of the chi-square law", "[kalman]") {
  constexpr double kGates[] = {6.6349, 9.2103, 11.3449, 13.2767};
  for (int k = 1; k <= 4; ++k) {
    CHECK(chi_square_quantile(0.99, k) == Approx(kGates[k - 1]).epsilon(0.0).margin(5e-5));
    CHECK(cdf(boost::math::chi_squared(k), chi_square_quantile(0.99, k)) ==
          Approx(0.99).epsilon(0.0).margin(1e-12));
  }
  CHECK(chi_square_quantile(0.9, 2) == Approx(-2.0 * std::log(0.1)).epsilon(1e-12));
  const auto check = [](int degrees, int runs, double low, double high) {
    const Interval interval = mean_interval(degrees, runs);
    CHECK(interval.low == Approx(low).epsilon(0.0).margin(6e-4));
    CHECK(interval.high == Approx(high).epsilon(0.0).margin(6e-4));
  };
  check(2, 50, 1.484, 2.591);
  check(2, 100, 1.627, 2.411);
  check(4, 100, 3.465, 4.573);
}
