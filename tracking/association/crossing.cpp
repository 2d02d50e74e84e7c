#include "tracking/association/crossing.h"

#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/waveform/doppler.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {
namespace {

// What a track expects to be measured.
struct Expected {
  Vector value;
  Matrix covariance;
};

Expected expected(const ImmState& state, Measured measured) {
  const Gaussian both = combined(state);
  // A measurement of zeros and without noise: what is left is the prediction and its curvature.
  const Observation one = observe(both, state.axes, measured, {});
  const Matrix jacobian = matrix_of(one.jacobian, one.size, both.size);
  Expected result;
  result.value = -vector_of({one.residual[0], one.residual[1], one.residual[2]}, one.size);
  result.covariance =
      jacobian * matrix_of(both.covariance, both.size, both.size) * jacobian.transpose();
  for (int i = 0; i < one.size; ++i)
    result.covariance(i, i) += one.noise[static_cast<std::size_t>(i)];
  return result;
}

Vector between(const Vector& a, const Vector& b) {
  Vector result = a - b;
  if (result.size() == 3) result(2) = signal::fold(result(2), core::kPi);
  return result;
}

Vector value_of(const RadarMeasurement& one, int size) {
  return vector_of({one.range_m, one.range_rate_mps, one.azimuth_rad}, size);
}

}  // namespace

double kept_by_difference(double before, double before_variance, double after,
                          double after_variance) {
  if (!(before_variance > 0.0) || !(after_variance > 0.0) || !std::isfinite(before) ||
      !std::isfinite(after))
    core::throw_input_error(core::ErrorClass::range, "variance", before_variance,
                            "above 0, with finite differences");
  const double amount =
      std::sqrt((before * before / before_variance + after * after / after_variance) /
                (1.0 / before_variance + 1.0 / after_variance));
  const auto positive = [&](double difference, double variance) {
    return 1.0 / (1.0 + std::exp(-2.0 * difference * amount / variance));
  };
  const double first = positive(before, before_variance);
  const double second = positive(after, after_variance);
  return first * second + (1.0 - first) * (1.0 - second);
}

double kept_probability(const ImmState& a, const ImmState& b, Measured measured,
                        const RadarMeasurement& c, const RadarMeasurement& d) {
  const Expected first = expected(a, measured), second = expected(b, measured);
  const int size = static_cast<int>(first.value.size());
  const Vector before = between(first.value, second.value);
  const Vector after = between(value_of(c, size), value_of(d, size));
  const Matrix before_covariance = first.covariance + second.covariance;
  Matrix after_covariance = Matrix::Zero(size, size);
  const double sigmas[][2] = {{c.range_sigma_m, d.range_sigma_m},
                              {c.range_rate_sigma_mps, d.range_rate_sigma_mps},
                              {c.azimuth_sigma_rad, d.azimuth_sigma_rad}};
  for (int i = 0; i < size; ++i)
    after_covariance(i, i) = sigmas[i][0] * sigmas[i][0] + sigmas[i][1] * sigmas[i][1];
  const Eigen::LLT<Matrix> sum(Matrix(before_covariance + after_covariance));
  if (sum.info() != Eigen::Success) return 0.5;
  const Vector by_after = sum.solve(after), by_before = sum.solve(before);
  const double sign = before.dot(by_after) < 0.0 ? -1.0 : 1.0;
  const Vector axis =
      sum.solve(Vector(before_covariance * by_after + sign * (after_covariance * by_before)));
  const double before_variance = axis.dot(before_covariance * axis);
  const double after_variance = axis.dot(after_covariance * axis);
  if (!(before_variance > 0.0) || !(after_variance > 0.0)) return 0.5;
  return kept_by_difference(axis.dot(before), before_variance, axis.dot(after), after_variance);
}

}  // namespace fanbeam::tracking
