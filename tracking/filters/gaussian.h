// A state estimate: mean and covariance of up to eleven numbers, as plain data.
//
// Planar states hold (x, y, vx, vy) and then (ax, ay) or the parts of turn rate and acceleration, x forward
// and y to the right of the radar; states of one axis hold (r, v) and then the acceleration. All in SI.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fanbeam::tracking {

inline constexpr int kMostStates = 11;
inline constexpr int kMostMeasured = 3;

using StateVector = std::array<double, kMostStates>;
using StateMatrix = std::array<double, kMostStates * kMostStates>;  // row after row

struct Gaussian {
  int size = 0;  // of it are used
  StateVector mean{};
  StateMatrix covariance{};

  double& variance(int row, int column) { return covariance[index(row, column)]; }
  double variance(int row, int column) const { return covariance[index(row, column)]; }
  bool operator==(const Gaussian&) const = default;

 private:
  static std::size_t index(int row, int column) {
    return static_cast<std::size_t>(row * kMostStates + column);
  }
};

struct WeightedGaussian {
  double weight = 0.0;
  Gaussian state;
};

// Mean and covariance of a mixture: sum w x, sum w (P + (x - mean)(x - mean)^T), weights brought to
// a sum of 1. At least one part with a weight above 0, all of one size; E-RANGE otherwise.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 1.4.16.
Gaussian moments(const std::vector<WeightedGaussian>& mixture);

// (x - mean)^T P^-1 (x - mean), the normalised estimation error squared when x is the truth; infinite
// where P is not positive definite.
double normalised_error_squared(const Gaussian& state, const StateVector& x);

// The first `size` components alone.
Gaussian marginal(const Gaussian& state, int size);

}  // namespace fanbeam::tracking
