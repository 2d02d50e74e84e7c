#include "tracking/filters/chi_square.h"

#include <cmath>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

// P(a, x) by its series, for x < a + 1.
double by_series(double a, double x, double front) {
  double term = 1.0 / a, sum = term;
  for (double n = a + 1.0; term > 1e-17 * sum; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return front * sum;
}

// 1 - P(a, x) by its continued fraction (Lentz).
double by_fraction(double a, double x, double front) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = numerator * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1.0 / d;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-16) break;
  }
  return front * h;
}

}  // namespace

double chi_square_probability(double x, double degrees) {
  if (!(x >= 0.0) || !std::isfinite(x))
    core::throw_input_error(core::ErrorClass::range, "chi_square.x", x, "finite, 0 or more");
  if (!(degrees > 0.0) || !std::isfinite(degrees))
    core::throw_input_error(core::ErrorClass::range, "chi_square.degrees", degrees,
                            "finite, above 0");
  if (x == 0.0) return 0.0;
  const double a = 0.5 * degrees, half = 0.5 * x;
  const double front = std::exp(a * std::log(half) - half - std::lgamma(a));
  return half < a + 1.0 ? by_series(a, half, front) : 1.0 - by_fraction(a, half, front);
}

double chi_square_quantile(double probability, double degrees) {
  if (!(probability > 0.0 && probability < 1.0))
    core::throw_input_error(core::ErrorClass::range, "chi_square.probability", probability,
                            "between 0 and 1");
  double low = 0.0, high = degrees + 1.0;
  while (chi_square_probability(high, degrees) < probability) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_probability(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Interval mean_interval(int degrees, int runs, double confidence) {
  if (degrees < 1 || runs < 1)
    core::throw_input_error(core::ErrorClass::range, "mean_interval.runs", runs, "1 or more");
  const double all = static_cast<double>(degrees) * runs, tail = 0.5 * (1.0 - confidence);
  return {chi_square_quantile(tail, all) / runs, chi_square_quantile(1.0 - tail, all) / runs};
}

}  // namespace fanbeam::tracking
