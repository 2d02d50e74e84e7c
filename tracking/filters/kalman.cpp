#include "tracking/filters/kalman.h"

#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/errors.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {
namespace {

constexpr double kLeastPivot = 1e-12;  // of the matrix scaled to a diagonal of 1

struct Innovation {
  Matrix jacobian, covariance_inverse, noise;
  Vector residual;
};

bool factor(const Gaussian& state, const Observation& observation, Innovation& parts,
            Update& told) {
  const int n = observation.size;
  parts.jacobian = matrix_of(observation.jacobian, n, state.size);
  parts.residual = Eigen::Map<const Eigen::Vector3d>(observation.residual.data()).head(n);
  parts.noise = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) parts.noise(i, i) = observation.noise[static_cast<std::size_t>(i)];
  const Matrix covariance = parts.jacobian * matrix_of(state.covariance, state.size, state.size) *
                                parts.jacobian.transpose() +
                            parts.noise;
  Vector scale(n);
  for (int i = 0; i < n; ++i) {
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() *
                            std::abs(observation.value[static_cast<std::size_t>(i)]);
    if (!(covariance(i, i) > rounding * rounding)) return false;
    scale(i) = 1.0 / std::sqrt(covariance(i, i));
  }
  const Eigen::LLT<Matrix> root(Matrix(scale.asDiagonal() * covariance * scale.asDiagonal()));
  if (root.info() != Eigen::Success) return false;
  const Matrix lower = root.matrixL();
  double log_determinant = 0.0;
  for (int i = 0; i < n; ++i) {
    if (lower(i, i) * lower(i, i) < kLeastPivot) return false;
    log_determinant += 2.0 * std::log(lower(i, i) / scale(i));
  }
  const Matrix identity = Matrix::Identity(n, n);
  parts.covariance_inverse = scale.asDiagonal() * root.solve(identity) * scale.asDiagonal();
  told.normalised_innovation_squared =
      parts.residual.dot(parts.covariance_inverse * parts.residual);
  told.log_likelihood =
      -0.5 * (told.normalised_innovation_squared + log_determinant + n * std::log(2.0 * core::kPi));
  told.applied = std::isfinite(told.log_likelihood);
  return told.applied;
}

void check(const Gaussian& state, const Observation& observation) {
  if (state.size < 1 || state.size > kMostStates || observation.size < 1 ||
      observation.size > kMostMeasured)
    core::throw_input_error(core::ErrorClass::range, "observation.size", observation.size,
                            "1 to 3, of a state of 1 to 11");
  for (std::size_t i = 0; i < static_cast<std::size_t>(observation.size); ++i) {
    if (!std::isfinite(observation.residual[i]) || !std::isfinite(observation.noise[i]))
      core::throw_input_error(core::ErrorClass::nonfinite, "observation", observation.residual[i],
                              "a finite residual and variance");
    if (observation.noise[i] < 0.0)
      core::throw_input_error(core::ErrorClass::range, "observation.noise", observation.noise[i],
                              "0 or more");
  }
}

}  // namespace

Update innovation(const Gaussian& state, const Observation& observation) {
  check(state, observation);
  Innovation parts;
  Update told;
  factor(state, observation, parts, told);
  return told;
}

Update update(Gaussian& state, const Observation& observation) {
  check(state, observation);
  Innovation parts;
  Update told;
  if (!factor(state, observation, parts, told)) return told;
  const int size = state.size;
  const Matrix prior = matrix_of(state.covariance, size, size);
  const Matrix gain = prior * parts.jacobian.transpose() * parts.covariance_inverse;
  const Matrix left = Matrix::Identity(size, size) - gain * parts.jacobian;
  const Matrix posterior = left * prior * left.transpose() + gain * parts.noise * gain.transpose();
  store(Vector(vector_of(state.mean, size) + gain * parts.residual), state.mean);
  store(Matrix(0.5 * (posterior + posterior.transpose())), state.covariance);
  store(gain, told.gain);
  return told;
}

}  // namespace fanbeam::tracking
