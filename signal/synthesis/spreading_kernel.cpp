#include "signal/synthesis/spreading_kernel.h"

#include <cmath>

#include "core/constants.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kBetaPerCell = 2.30;
constexpr int kNodes = 64;  // of the transform's sum

// Interpolation at Chebyshev points, then powers: for u in [-1, 1] and these degrees the powers
// lose no more than three digits.
std::vector<double> power_coefficients(const std::vector<double>& at_nodes) {
  const int count = static_cast<int>(at_nodes.size());
  std::vector<std::vector<double>> chebyshev(at_nodes.size(),
                                             std::vector<double>(at_nodes.size(), 0.0));
  chebyshev[0][0] = 1.0;
  chebyshev[1][1] = 1.0;
  for (std::size_t k = 2; k < chebyshev.size(); ++k)
    for (std::size_t power = 0; power < chebyshev.size(); ++power)
      chebyshev[k][power] =
          (power > 0 ? 2.0 * chebyshev[k - 1][power - 1] : 0.0) - chebyshev[k - 2][power];
  std::vector<double> powers(at_nodes.size(), 0.0);
  for (int k = 0; k < count; ++k) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
      sum += at_nodes[static_cast<std::size_t>(i)] * std::cos(core::kPi * k * (i + 0.5) / count);
    const double coefficient = sum * (k == 0 ? 1.0 : 2.0) / count;
    for (std::size_t power = 0; power < powers.size(); ++power)
      powers[power] += coefficient * chebyshev[static_cast<std::size_t>(k)][power];
  }
  return powers;
}

}  // namespace

SpreadingKernel::SpreadingKernel(int width) : width_(width), beta_(kBetaPerCell * width) {
  check_count("kernel width", width, 2, 16);
  const int count = degree() + 1;
  for (int tap = 0; tap < width; ++tap) {
    std::vector<double> at_nodes;
    for (int i = 0; i < count; ++i) {
      const double u = std::cos(core::kPi * (i + 0.5) / count);
      at_nodes.push_back(value(-0.5 * width + tap + 0.5 * (u + 1.0)));
    }
    const std::vector<double> powers = power_coefficients(at_nodes);
    taps_.insert(taps_.end(), powers.begin(), powers.end());
  }
  // t = (w / 2) sin(a): the root becomes a cosine, and what is wrong at the ends of a midpoint sum
  // is of the order exp(-beta) (step in a)^2. One half, doubled.
  const double step_rad = 0.5 * core::kPi / kNodes;
  for (int i = 0; i < kNodes; ++i) {
    const double a = (i + 0.5) * step_rad;
    nodes_.push_back(0.5 * width * std::sin(a));
    weights_.push_back(width * step_rad * std::exp(beta_ * (std::cos(a) - 1.0)) * std::cos(a));
  }
}

double SpreadingKernel::value(double offset_cells) const {
  const double z = 2.0 * offset_cells / width_;
  const double under = 1.0 - z * z;
  return under < 0.0 ? 0.0 : std::exp(beta_ * (std::sqrt(under) - 1.0));
}

double SpreadingKernel::transform(double turns_per_cell) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    sum += weights_[i] * std::cos(2.0 * core::kPi * nodes_[i] * turns_per_cell);
  return sum;
}

double spreading_error(int width) {
  check_count("kernel width", width, kSpreadingErrors.front().width, 16);
  double relative = 0.0;
  for (const SpreadingError& error : kSpreadingErrors)
    if (error.width <= width) relative = error.relative;
  return relative;
}

int kernel_width(double relative_error) {
  for (const SpreadingError& error : kSpreadingErrors)
    if (error.width % 2 == 0 && error.relative <= 0.25 * relative_error) return error.width;
  return kSpreadingErrors.back().width;
}

}  // namespace fanbeam::signal
