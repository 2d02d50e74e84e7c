// Where a function that falls without end from a positive value at 0 meets 0, by bisection.
#pragma once

#include <limits>

namespace fanbeam::signal {

// To `tolerance` of the root; infinity where it lies beyond `most`.
template <typename Function>
double falling_root(const Function& falling, double most, double tolerance) {
  double low = 0.0;
  double high = 1.0;
  while (falling(high) > 0.0) {
    low = high;
    high *= 2.0;
    if (high > most) return std::numeric_limits<double>::infinity();
  }
  // A root far below 1 takes a step for every halving more.
  for (int step = 0; step < 200 && high - low > tolerance * high; ++step) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace fanbeam::signal
