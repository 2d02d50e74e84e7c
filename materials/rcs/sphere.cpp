#include "materials/rcs/sphere.h"

#include <cmath>
#include <complex>

#include "core/constants.h"

namespace fanbeam::materials {
namespace {

using Complex = std::complex<double>;

constexpr double kSphereOpticsFrom = 50.0;
// What a term this far down adds cannot be seen, and its successors would overflow.
constexpr double kLargestSphereHankel = 1e100;

// sigma / (pi a^2) by the series.
double relative_rcs(double ka) {
  Complex before(std::cos(ka), -std::sin(ka));  // n = -1
  Complex hankel(std::sin(ka), std::cos(ka));   // n = 0
  Complex sum = 0.0;
  const int terms = static_cast<int>(ka + 4.0 * std::cbrt(ka) + 10.0);
  for (int n = 1; n <= terms && std::abs(hankel) < kLargestSphereHankel; ++n) {
    const Complex next = (2.0 * n - 1.0) / ka * hankel - before;
    before = hankel;
    hankel = next;
    const Complex derivative = before - n / ka * hankel;
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    sum += sign * (2.0 * n + 1.0) / (hankel * derivative);
  }
  return std::norm(sum) / (ka * ka);
}

}  // namespace

double sphere_rcs_m2(double radius_m, double wavelength_m) {
  const double ka = 2.0 * core::kPi * radius_m / wavelength_m;
  const double disc_m2 = core::kPi * radius_m * radius_m;
  return ka > kSphereOpticsFrom ? disc_m2 : disc_m2 * relative_rcs(ka);
}

}  // namespace fanbeam::materials
