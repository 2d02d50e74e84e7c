#include "materials/rcs/round_wire.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/constants.h"
#include "materials/rcs/lobe.h"

namespace fanbeam::materials {
namespace {

using Complex = std::complex<double>;

constexpr double kGeometricalOpticsFrom = 50.0;
// Seen end on there is no broadside to speak of, and the Hankel functions have no value at 0.
constexpr double kEndOnBelow = 1e-12;
// What a term this far down adds cannot be seen, and its successors would overflow.
constexpr double kLargestHankel = 1e100;

struct Amplitudes {
  Complex parallel, perpendicular;  // T and V of the header
};

Amplitudes amplitudes_at(double x) {
  Complex before(std::cyl_bessel_j(0.0, x), -std::cyl_neumann(0.0, x));
  Complex hankel(std::cyl_bessel_j(1.0, x), -std::cyl_neumann(1.0, x));
  // The derivative of order 0 is minus order 1.
  Amplitudes sum{before.real() / before, hankel.real() / hankel};
  const int terms = static_cast<int>(x + 4.0 * std::cbrt(x) + 10.0);
  for (int n = 1; n <= terms && std::abs(hankel) < kLargestHankel; ++n) {
    // Recurring upwards, errors of J grow like H and stay a rounding of their ratio.
    const Complex derivative = before - n / x * hankel;
    const double weight = n % 2 == 0 ? 2.0 : -2.0;
    sum.parallel += weight * hankel.real() / hankel;
    sum.perpendicular += weight * derivative.real() / derivative;
    const Complex next = 2.0 * n / x * hankel - before;
    before = hankel;
    hankel = next;
  }
  return sum;
}

// |T cos^2 p - V sin^2 p|^2.
double squared_amplitude(double x, double polarisation_rad) {
  if (x < kEndOnBelow) return 0.0;
  if (x > kGeometricalOpticsFrom) return core::kPi * x / 4.0;
  const Amplitudes amplitudes = amplitudes_at(x);
  const double along = std::cos(polarisation_rad) * std::cos(polarisation_rad);
  return std::norm(amplitudes.parallel * along - amplitudes.perpendicular * (1.0 - along));
}

}  // namespace

double round_wire_rcs_m2(double radius_m, double length_m, double polarisation_rad,
                         double sin_off_broadside, double wavelength_m) {
  const double wave_number_per_m = 2.0 * core::kPi / wavelength_m;
  const double sine = std::clamp(sin_off_broadside, -1.0, 1.0);
  const double x = wave_number_per_m * radius_m * std::sqrt(1.0 - sine * sine);
  return 4.0 * length_m * length_m / core::kPi * squared_amplitude(x, polarisation_rad) *
         sinc_squared(wave_number_per_m * length_m * sine);
}

}  // namespace fanbeam::materials
