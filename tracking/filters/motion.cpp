#include "tracking/filters/motion.h"

#include <cmath>

#include "core/errors.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {
namespace {

struct Step {
  Vector mean;
  Matrix jacobian, noise;
};

void check(const MotionModel& model, double step_s, const Gaussian& state) {
  if (!std::isfinite(step_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "step_s", step_s, "a finite step");
  if (step_s < 0.0) core::throw_input_error(core::ErrorClass::time, "step_s", step_s, "0 or later");
  for (const double noise : {model.acceleration_mps2, model.jerk_density_m2_per_s5,
                             model.lateral_jerk_share, model.turn_density_rad2_per_s3})
    if (!(noise >= 0.0) || !std::isfinite(noise))
      core::throw_input_error(core::ErrorClass::range, "motion noise", noise, "finite, 0 or more");
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

Step turn_step(const MotionModel& model, double step_s, const Gaussian& state) {
  const double t = step_s, rate = state.mean[4], angle = rate * t;
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
  Step step{Vector(5), Matrix::Identity(5, 5), Matrix::Zero(5, 5)};
  step.mean << state.mean[0] + s * gx - c * gy - model.radar_velocity_mps[0] * t,
      state.mean[1] + c * gx + s * gy - model.radar_velocity_mps[1] * t,
      cosine * gx - sine * gy - model.radar_velocity_mps[0],
      sine * gx + cosine * gy - model.radar_velocity_mps[1], rate;
  step.jacobian.block(0, 2, 4, 3) << s, -c, ds * gx - dc * gy,  //
      c, s, dc * gx + ds * gy,                                  //
      cosine, -sine, -t * (sine * gx + cosine * gy),            //
      sine, cosine, t * (cosine * gx - sine * gy);
  const double sa2 = model.acceleration_mps2 * model.acceleration_mps2;
  for (int axis = 0; axis < 2; ++axis) {
    step.noise(axis, axis) = sa2 * t * t * t * t / 4;
    step.noise(axis, axis + 2) = step.noise(axis + 2, axis) = sa2 * t * t * t / 2;
    step.noise(axis + 2, axis + 2) = sa2 * t * t;
  }
  step.noise(4, 4) = model.turn_density_rad2_per_s3 * t;
  return step;
}

}  // namespace

int states(const MotionModel& model) {
  if (model.kind == MotionKind::coordinated_turn) return 5;
  if (model.axes != 1 && model.axes != 2)
    core::throw_input_error(core::ErrorClass::range, "motion.axes", model.axes, "1 or 2");
  return model.axes * (model.kind == MotionKind::constant_velocity ? 2 : 3);
}

void predict(const MotionModel& model, double step_s, Gaussian& state) {
  check(model, step_s, state);
  if (step_s == 0.0) return;
  const Step step = model.kind == MotionKind::coordinated_turn
                        ? turn_step(model, step_s, state)
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
