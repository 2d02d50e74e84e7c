#include "atmosphere/precipitation/mie.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fanbeam::atmosphere {
namespace {

using Complex = std::complex<double>;

// D_n(z) = d ln(psi_n(z)) / dz for n = 0 to `last`, by D_(n-1) = n/z - 1/(D_n + n/z). The start
// value is forgotten above n = |z|, where psi_n decays; within about |z|^(1/3) of it only slowly.
template <typename Number>
std::vector<Number> logarithmic_derivatives(Number z, int last) {
  const double size = std::abs(z);
  const int start = std::max(last, static_cast<int>(size + 8.0 * std::cbrt(size))) + 16;
  std::vector<Number> derivatives(static_cast<std::size_t>(start) + 1, Number(0.0));
  for (int n = start; n > 0; --n) {
    const auto index = static_cast<std::size_t>(n);
    const Number ratio = static_cast<double>(n) / z;
    derivatives[index - 1] = ratio - 1.0 / (derivatives[index] + ratio);
  }
  return derivatives;
}

}  // namespace

MieEfficiencies mie_efficiencies(double x, Complex m) {
  const int terms = static_cast<int>(x + 4.05 * std::cbrt(x) + 2.0);
  const std::vector<Complex> inside = logarithmic_derivatives(m * x, terms);
  const std::vector<double> outside = logarithmic_derivatives(x, terms);

  double psi = std::sin(x);          // psi_n, from psi_(n-1) = (n/x + D_n) psi_n
  double chi_before = -std::sin(x);  // chi_(n-1)
  double chi = std::cos(x);
  double extinction = 0.0;
  Complex backward(0.0);
  double sign = -1.0;
  for (int n = 1; n <= terms; ++n) {
    const auto index = static_cast<std::size_t>(n);
    const double ratio = n / x;
    const double psi_before = psi;
    psi = psi_before / (outside[index] + ratio);
    const double chi_next = (2.0 * n - 1.0) / x * chi - chi_before;
    chi_before = chi;
    chi = chi_next;
    const Complex xi(psi, -chi);
    const Complex xi_before(psi_before, -chi_before);

    const Complex electric = inside[index] / m;
    const Complex magnetic = inside[index] * m;
    const Complex a = psi * (electric - outside[index]) / ((electric + ratio) * xi - xi_before);
    const Complex b = psi * (magnetic - outside[index]) / ((magnetic + ratio) * xi - xi_before);
    const double weight = 2.0 * n + 1.0;
    extinction += weight * (a + b).real();
    backward += sign * weight * (a - b);
    sign = -sign;
  }
  const double per_square = 1.0 / (x * x);
  return {2.0 * per_square * extinction, per_square * std::norm(backward)};
}

}  // namespace fanbeam::atmosphere
