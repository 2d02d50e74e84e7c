#include "sensors/receiver/integer_gamma.h"

#include <cmath>

namespace fanbeam::sensors {

double poisson_probability(int k, double x) {
  if (!(x > 0.0)) return k == 0 ? 1.0 : 0.0;
  if (std::isinf(x)) return 0.0;
  return std::exp(k * std::log(x) - x - std::lgamma(k + 1.0));
}

double upper_gamma(int n, double x) {
  double sum = 0.0;
  for (int k = 0; k < n; ++k) sum += poisson_probability(k, x);
  return sum < 1.0 ? sum : 1.0;
}

double upper_gamma_inverse(int n, double q) {
  double low = 0.0;
  double high = n;
  while (upper_gamma(n, high) > q) {
    low = high;
    high *= 2.0;
  }
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (upper_gamma(n, middle) > q ? low : high) = middle;
  }
}

}  // namespace fanbeam::sensors
