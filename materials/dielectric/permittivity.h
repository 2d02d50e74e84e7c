// Complex relative permittivity, with the sign convention that the models of this folder share.
#pragma once

#include <complex>

namespace fanbeam::materials {

// eps = real - j loss, for the time dependence exp(+j omega t); a passive medium has loss >= 0.
struct Permittivity {
  double real = 1.0;
  double loss = 0.0;

  bool operator==(const Permittivity&) const = default;
  // The sign of a zero imaginary part is kept negative: it decides the branch of square roots.
  std::complex<double> complex() const { return {real, -loss}; }
};

inline constexpr double kLargestPermittivity = 1e12;

// Throws InputError E-RANGE (real outside 1..1e12, loss outside 0..1e12: a negative loss would be
// gain) or E-NONFINITE.
void check_permittivity(const Permittivity& permittivity);

}  // namespace fanbeam::materials
