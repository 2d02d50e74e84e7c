#include "tracking/filters/gaussian.h"

#include <cmath>
#include <limits>

#include "core/errors.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {

Gaussian moments(const std::vector<WeightedGaussian>& mixture) {
  double total = 0.0;
  for (const WeightedGaussian& part : mixture) total += part.weight;
  if (!(total > 0.0) || !std::isfinite(total))
    core::throw_input_error(core::ErrorClass::range, "mixture.weights", total,
                            "a finite sum above 0");
  const int size = mixture.front().state.size;
  Vector mean = Vector::Zero(size);
  for (const WeightedGaussian& part : mixture) {
    if (part.state.size != size)
      core::throw_input_error(core::ErrorClass::range, "mixture.state.size", part.state.size,
                              "the same size for all parts");
    mean += part.weight / total * vector_of(part.state.mean, size);
  }
  Matrix covariance = Matrix::Zero(size, size);
  for (const WeightedGaussian& part : mixture) {
    const Vector offset = vector_of(part.state.mean, size) - mean;
    covariance += part.weight / total *
                  (matrix_of(part.state.covariance, size, size) + offset * offset.transpose());
  }
  Gaussian result;
  result.size = size;
  store(mean, result.mean);
  store(Matrix(0.5 * (covariance + covariance.transpose())), result.covariance);
  return result;
}

Gaussian marginal(const Gaussian& state, int size) {
  if (size < 1 || size > state.size)
    core::throw_input_error(core::ErrorClass::range, "marginal.size", size,
                            "1 to the size of the state");
  Gaussian result;
  result.size = size;
  store(vector_of(state.mean, size), result.mean);
  store(matrix_of(state.covariance, size, size), result.covariance);
  return result;
}

double normalised_error_squared(const Gaussian& state, const StateVector& x) {
  const Eigen::LLT<Matrix> root(matrix_of(state.covariance, state.size, state.size));
  if (root.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Vector apart = vector_of(x, state.size) - vector_of(state.mean, state.size);
  const Vector solved = root.matrixL().solve(apart);
  return solved.squaredNorm();
}

}  // namespace fanbeam::tracking
