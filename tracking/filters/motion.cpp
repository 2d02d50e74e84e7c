#include "tracking/filters/motion.h"

#include <cmath>
#include <utility>

#include "core/errors.h"
#include "tracking/filters/smooth_turn_private.h"

namespace fanbeam::tracking {
namespace {

void check(const MotionModel& model, double step_s, const Gaussian& state) {
  if (!std::isfinite(step_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "step_s", step_s, "a finite step");
  if (step_s < 0.0) core::throw_input_error(core::ErrorClass::time, "step_s", step_s, "0 or later");
  for (const double noise :
       {model.acceleration_mps2, model.jerk_density_m2_per_s5, model.lateral_jerk_share,
        model.steering_sigma_rad_per_s, model.along_sigma_mps2, model.bend_density_rad2_per_s3,
        model.bend_sigma_rad_per_s})
    if (!(noise >= 0.0) || !std::isfinite(noise))
      core::throw_input_error(core::ErrorClass::range, "motion noise", noise, "finite, 0 or more");
  for (const auto& [name, time_s] : {std::pair{"motion.steering_time_s", model.steering_time_s},
                                     {"motion.along_time_s", model.along_time_s}})
    if (!(time_s > 0.0) || !std::isfinite(time_s))
      core::throw_input_error(core::ErrorClass::range, name, time_s, "finite, above 0");
  if (state.size != states(model))
    core::throw_input_error(core::ErrorClass::range, "state.size", state.size,
                            core::number_text(states(model)));
}

// Derivatives of position up to `orders - 1`; the same law on every axis.
MotionStep polynomial_step(const MotionModel& model, double step_s, const Gaussian& state) {
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
  MotionStep step{Vector(size), Matrix::Zero(size, size), Matrix::Zero(size, size)};
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

}  // namespace

int states(const MotionModel& model) {
  if (model.kind == MotionKind::smooth_turn) return kTurnStates;
  if (model.axes != 1 && model.axes != 2)
    core::throw_input_error(core::ErrorClass::range, "motion.axes", model.axes, "1 or 2");
  return model.axes * (model.kind == MotionKind::constant_velocity ? 2 : 3);
}

void add_turn(const MotionModel& model, Gaussian& state) {
  state.size = states(model);
  const auto add_smooth = [&](int at, double sigma, double time_s) {
    const double variance = sigma * sigma, k2 = 1.0 / (time_s * time_s);
    state.variance(at, at) = variance;
    state.variance(at + 1, at + 1) = variance * k2 / 3.0;
    state.variance(at + 2, at + 2) = variance * k2 * k2;
    state.variance(at, at + 2) = state.variance(at + 2, at) = -variance * k2 / 3.0;
  };
  add_smooth(kSteering, model.steering_sigma_rad_per_s, model.steering_time_s);
  state.variance(kBend, kBend) = std::pow(model.bend_sigma_rad_per_s, 2);
  add_smooth(kAlong, model.along_sigma_mps2, model.along_time_s);
}

void predict(const MotionModel& model, double step_s, Gaussian& state) {
  check(model, step_s, state);
  if (step_s == 0.0) return;
  const MotionStep step = model.kind == MotionKind::smooth_turn
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
