#include "materials/rcs/round_wire.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

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

// The largest |T| and |V| at any of these x so far, a 24th of the ripple's period apart.
constexpr double kRippleStep =
    0.049;  // none of them 2, where the library's series divides by zero, harmlessly
struct Largest {
  double parallel, perpendicular;
};
std::vector<Largest> running_maxima() {
  std::vector<Largest> found;
  Largest most{0.0, 0.0};
  for (int k = 1; k * kRippleStep <= kGeometricalOpticsFrom; ++k) {
    const Amplitudes here = amplitudes_at(k * kRippleStep);
    most.parallel = std::max(most.parallel, std::abs(here.parallel));
    most.perpendicular = std::max(most.perpendicular, std::abs(here.perpendicular));
    found.push_back(most);
  }
  return found;
}

Largest largest_up_to(double x) {
  static const std::vector<Largest> maxima = running_maxima();
  if (x < kEndOnBelow) return {0.0, 0.0};
  const auto steps = static_cast<std::size_t>(std::min(x, kGeometricalOpticsFrom) / kRippleStep);
  const Largest before = steps > 0 ? maxima[std::min(steps, maxima.size()) - 1] : Largest{0.0, 0.0};
  if (x > kGeometricalOpticsFrom) {
    const double optics = std::sqrt(core::kPi * x / 4.0);
    return {std::max(before.parallel, optics), std::max(before.perpendicular, optics)};
  }
  const Amplitudes here = amplitudes_at(x);
  return {std::max(before.parallel, std::abs(here.parallel)),
          std::max(before.perpendicular, std::abs(here.perpendicular))};
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

double largest_round_wire_rcs_m2(double radius_m, double length_m, double polarisation_rad,
                                 double wavelength_m) {
  constexpr double kBetweenSteps = 1.02;  // of the power
  const Largest most = largest_up_to(2.0 * core::kPi / wavelength_m * radius_m);
  const double along = std::cos(polarisation_rad) * std::cos(polarisation_rad);
  const double sum = most.parallel * along + most.perpendicular * (1.0 - along);
  return kBetweenSteps * 4.0 * length_m * length_m / core::kPi * sum * sum;
}

}  // namespace fanbeam::materials
