// The lobe of an evenly lit aperture.
#pragma once

#include <cmath>

namespace fanbeam::materials {

// (sin x / x)^2, 1 at 0. Half of it at x = 1.3916, the first null at pi.
inline double sinc_squared(double x) {
  if (std::abs(x) < 1e-8) return 1.0;
  const double sinc = std::sin(x) / x;
  return sinc * sinc;
}

}  // namespace fanbeam::materials
