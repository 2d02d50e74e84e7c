#include "tracking/filters/motion.h"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/errors.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {
namespace {

// What the means over a step have of the noise of f and b at its end: of f as a cubic's mean has (by regression on f
// 5/18, for steps short beside 1 / k), of b what regression gives for any step.
constexpr double kSteeredWithin = 0.25, kBentWithin = 0.5;
// Slower than this a velocity tells little of where a car points: it is then taken to point as the radar does.
constexpr double kCrawl_mps = 0.5;

struct Step {
  Vector mean;
  Matrix jacobian, noise;
};

void check(const MotionModel& model, double step_s, const Gaussian& state) {
  if (!std::isfinite(step_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "step_s", step_s, "a finite step");
  if (step_s < 0.0) core::throw_input_error(core::ErrorClass::time, "step_s", step_s, "0 or later");
  for (const double noise :
       {model.acceleration_mps2, model.jerk_density_m2_per_s5, model.lateral_jerk_share,
        model.steering_sigma_rad_per_s, model.bend_density_rad2_per_s3, model.bend_sigma_rad_per_s})
    if (!(noise >= 0.0) || !std::isfinite(noise))
      core::throw_input_error(core::ErrorClass::range, "motion noise", noise, "finite, 0 or more");
  if (!(model.steering_time_s > 0.0) || !std::isfinite(model.steering_time_s))
    core::throw_input_error(core::ErrorClass::range, "motion.steering_time_s",
                            model.steering_time_s, "finite, above 0");
  if (state.size != states(model))
    core::throw_input_error(core::ErrorClass::range, "state.size", state.size,
                            core::number_text(states(model)));
}

// Derivatives of position up to `orders - 1`; the same law on every axis.
Step polynomial_step(const MotionModel& model, double step_s, const Gaussian& state) {
  const bool velocity = model.kind == MotionKind::constant_velocity;
  const int orders = velocity ? 2 : 3, axes = model.axes, size = state.size;
  const double t = step_s, t2 = t * t, t3 = t2 * t;
  const double sa2 = model.acceleration_mps2 * model.acceleration_mps2;
  const double q = model.jerk_density_m2_per_s5;
  const double slope[3] = {1.0, t, 0.5 * t2};
  const double white_acceleration[2][2] = {{sa2 * t2 * t2 / 4, sa2 * t3 / 2},
                                           {sa2 * t3 / 2, sa2 * t2}};
  const double white_jerk[3][3] = {{q * t3 * t2 / 20, q * t2 * t2 / 8, q * t3 / 6},
                                   {q * t2 * t2 / 8, q * t3 / 3, q * t2 / 2},
                                   {q * t3 / 6, q * t2 / 2, q * t}};
  Step step{Vector(size), Matrix::Zero(size, size), Matrix::Zero(size, size)};
  for (int axis = 0; axis < axes; ++axis) {
    const double share = axis == 0 ? 1.0 : model.lateral_jerk_share;
    for (int row = 0; row < orders; ++row)
      for (int column = 0; column < orders; ++column) {
        const int r = row * axes + axis, c = column * axes + axis;
        if (column >= row) step.jacobian(r, c) = slope[column - row];
        step.noise(r, c) =
            velocity ? white_acceleration[row][column] : share * white_jerk[row][column];
      }
  }
  step.mean = step.jacobian * vector_of(state.mean, size);
  return step;
}

// Integrals of s^n exp(-rate s) over a step, n = 0 to 4: the last is a gamma function's, the others follow from
// it downwards, in terms that are all positive.
std::array<double, 5> decaying_powers(double rate_per_s, double t) {
  using Double = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const double x = rate_per_s * t, decay = std::exp(-x);
  std::array<double, 5> integrals{};
  integrals[4] = 24.0 / std::pow(rate_per_s, 5) * boost::math::gamma_p(5.0, x, Double());
  for (std::size_t n = 4; n > 0; --n)
    integrals[n - 1] =
        (rate_per_s * integrals[n] + std::pow(t, n) * decay) / static_cast<double>(n);
  return integrals;
}

// The law of (f, f', f'') over a step.
struct Steering {
  Eigen::Matrix3d transition, noise;
  Eigen::RowVector3d mean_rate;  // of f over the step, expected from its start
};

Steering steering(const MotionModel& model, double t) {
  const double k = 1.0 / model.steering_time_s, k2 = k * k, k3 = k2 * k;
  Eigen::Matrix3d beyond_decay;
  beyond_decay << k, 1.0, 0.0, 0.0, k, 1.0, -k3, -3.0 * k2, -2.0 * k;
  Steering result;
  result.transition = std::exp(-k * t) * (Eigen::Matrix3d::Identity() + t * beyond_decay +
                                          0.5 * t * t * beyond_decay * beyond_decay);
  const std::array<double, 5> mean = decaying_powers(k, t);
  result.mean_rate << mean[0] + k * mean[1] + 0.5 * k2 * mean[2], mean[1] + k * mean[2],
      0.5 * mean[2];
  result.mean_rate /= t;
  // Products of what a push leaves s later: exp(-k s) (s^2/2, s - k s^2/2, 1 - 2 k s + k^2 s^2/2).
  const auto [i0, i1, i2, i3, i4] = decaying_powers(2.0 * k, t);
  const double ww = 0.25 * i4, wd = 0.5 * i3 - 0.25 * k * i4;
  const double wc = 0.5 * i2 - k * i3 + 0.25 * k2 * i4, dd = i2 - k * i3 + 0.25 * k2 * i4;
  const double dc = i1 - 2.5 * k * i2 + 1.5 * k2 * i3 - 0.25 * k3 * i4;
  const double cc = i0 - 4.0 * k * i1 + 5.0 * k2 * i2 - 2.0 * k3 * i3 + 0.25 * k2 * k2 * i4;
  result.noise << ww, wd, wc, wd, dd, dc, wc, dc, cc;
  result.noise *= 16.0 / 3.0 * std::pow(model.steering_sigma_rad_per_s, 2) * k2 * k3;
  return result;
}

Step turn_step(const MotionModel& model, double step_s, const Gaussian& state) {
  const Steering law = steering(model, step_s);
  const Eigen::Vector3d turning = vector_of(state.mean, state.size).segment(4, 3);
  const double t = step_s, rate = law.mean_rate * turning + state.mean[7], angle = rate * t;
  const double gx = state.mean[2] + model.radar_velocity_mps[0];
  const double gy = state.mean[3] + model.radar_velocity_mps[1];
  const double sine = std::sin(angle), cosine = std::cos(angle);
  double s = t * (1.0 - angle * angle / 6.0), c = 0.5 * t * angle;
  double ds = -t * t * angle / 3.0, dc = t * t * (0.5 - angle * angle / 8.0);
  if (std::abs(angle) > 1e-4) {
    const double half = std::sin(0.5 * angle);
    s = sine / rate;
    c = 2.0 * half * half / rate;
    ds = (angle * cosine - sine) / (rate * rate);
    dc = (angle * sine - 2.0 * half * half) / (rate * rate);
  }
  Step step{Vector(8), Matrix::Identity(8, 8), Matrix::Zero(8, 8)};
  step.mean << state.mean[0] + s * gx - c * gy - model.radar_velocity_mps[0] * t,
      state.mean[1] + c * gx + s * gy - model.radar_velocity_mps[1] * t,
      cosine * gx - sine * gy - model.radar_velocity_mps[0],
      sine * gx + cosine * gy - model.radar_velocity_mps[1], law.transition * turning,
      state.mean[7];
  step.jacobian.block(0, 2, 4, 2) << s, -c, c, s, cosine, -sine, sine, cosine;
  const Eigen::Vector4d by_rate(ds * gx - dc * gy, dc * gx + ds * gy,
                                -t * (sine * gx + cosine * gy), t * (cosine * gx - sine * gy));
  step.jacobian.block(0, 4, 4, 3) = by_rate * law.mean_rate;
  step.jacobian.block(4, 4, 3, 3) = law.transition;
  step.jacobian.block(0, 7, 4, 1) = by_rate;
  Matrix into = Matrix::Zero(8, 4), noise = Matrix::Zero(4, 4);
  into.block(0, 0, 4, 1) = kSteeredWithin * by_rate;
  into.block(0, 3, 4, 1) = kBentWithin * by_rate;
  into.block(4, 0, 4, 4).setIdentity();
  noise.block(0, 0, 3, 3) = law.noise;
  noise(3, 3) = model.bend_density_rad2_per_s3 * t;
  const double speed_mps = std::hypot(gx, gy);
  const bool crawls = speed_mps < kCrawl_mps;
  const double ux = crawls ? 1.0 : gx / speed_mps, uy = crawls ? 0.0 : gy / speed_mps;
  Vector along = Vector::Zero(8);
  along.head(4) << 0.5 * t * t * ux, 0.5 * t * t * uy, t * ux, t * uy;
  along *= model.acceleration_mps2;
  step.noise = into * noise * into.transpose() + along * along.transpose();
  return step;
}

}  // namespace

int states(const MotionModel& model) {
  if (model.kind == MotionKind::smooth_turn) return 8;
  if (model.axes != 1 && model.axes != 2)
    core::throw_input_error(core::ErrorClass::range, "motion.axes", model.axes, "1 or 2");
  return model.axes * (model.kind == MotionKind::constant_velocity ? 2 : 3);
}

void add_turn(const MotionModel& model, Gaussian& state) {
  const double variance = std::pow(model.steering_sigma_rad_per_s, 2);
  const double k2 = std::pow(model.steering_time_s, -2.0);
  state.size = states(model);
  state.variance(4, 4) = variance;
  state.variance(5, 5) = variance * k2 / 3.0;
  state.variance(6, 6) = variance * k2 * k2;
  state.variance(7, 7) = std::pow(model.bend_sigma_rad_per_s, 2);
  state.variance(4, 6) = state.variance(6, 4) = -variance * k2 / 3.0;
}

void predict(const MotionModel& model, double step_s, Gaussian& state) {
  check(model, step_s, state);
  if (step_s == 0.0) return;
  const Step step = model.kind == MotionKind::smooth_turn ? turn_step(model, step_s, state)
                                                          : polynomial_step(model, step_s, state);
  const Matrix moved = step.jacobian * matrix_of(state.covariance, state.size, state.size) *
                           step.jacobian.transpose() +
                       step.noise;
  if (!moved.allFinite() || !step.mean.allFinite())
    core::throw_input_error(core::ErrorClass::range, "step_s", step_s,
                            "a step that keeps the covariance finite");
  store(step.mean, state.mean);
  store(Matrix(0.5 * (moved + moved.transpose())), state.covariance);
}

}  // namespace fanbeam::tracking
