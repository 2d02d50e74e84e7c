// Judging samples: moments and chi-square against cells of equal probability.
#pragma once

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace fanbeam::tests {

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

inline Moments moments(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  Moments result;
  for (const double value : values) result.mean += value / count;
  for (const double value : values)
    result.variance += (value - result.mean) * (value - result.mean) / (count - 1.0);
  return result;
}

inline double correlation(std::span<const double> a, std::span<const double> b) {
  const Moments of_a = moments(a);
  const Moments of_b = moments(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / static_cast<double>(a.size()) / std::sqrt(of_a.variance * of_b.variance);
}

// Over 64 cells of equal probability under the law whose survival function is P(X > x).
inline double chi_square_64(std::span<const double> values,
                            const std::function<double(double)>& survival) {
  std::vector<double> counts(64, 0.0);
  for (const double value : values) {
    const auto cell = static_cast<std::size_t>(64.0 * survival(value));
    counts[cell < 64 ? cell : 63] += 1.0;
  }
  const double expected = static_cast<double>(values.size()) / 64.0;
  double sum = 0.0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// What chi-square of 63 degrees exceeds with probability 0.0025.
inline double chi_square_64_limit() { return 2.0 * boost::math::gamma_q_inv(31.5, 0.0025); }

// Four standard deviations of a measured probability.
inline double binomial_margin(double probability, double count) {
  return 4.0 * std::sqrt(probability * (1.0 - probability) / count);
}

}  // namespace fanbeam::tests
