#include "atmosphere/precipitation/melting_layer.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::atmosphere {
namespace {

// The place of the largest multiple, found numerically; the multiple rises above and falls below.
constexpr double kPeak_m = -240.584;

}  // namespace

double melting_multiple(double d) noexcept {
  if (d > 0.0) return 0.0;
  if (d < -kMeltingDepth_m) return 1.0;
  const double g = -std::expm1(d / 70.0);
  const double s = -std::expm1(-(d / 600.0) * (d / 600.0));
  const double wet = 4.0 * g * g;
  return wet / (1.0 + s * s * (wet - 1.0));
}

double largest_melting_multiple(double lowest_m, double highest_m) noexcept {
  return melting_multiple(std::clamp(kPeak_m, lowest_m, highest_m));
}

}  // namespace fanbeam::atmosphere
