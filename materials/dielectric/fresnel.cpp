#include "materials/dielectric/fresnel.h"

#include <cmath>

#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::materials {

FresnelReflection fresnel_reflection(const Permittivity& permittivity, double incidence_rad) {
  check_permittivity(permittivity);
  core::require_range("incidence_rad", incidence_rad, {0.0, core::kPi / 2.0});
  // Without a boundary nothing is reflected, also at grazing, where the formulas read 0/0.
  if (permittivity.real == 1.0 && permittivity.loss == 0.0) return {0.0, 0.0};

  const double cos_t = std::cos(incidence_rad);
  const std::complex<double> eps = permittivity.complex();
  // eps - sin^2 without cancellation for eps near 1; loss >= 0 puts the principal root on the
  // decaying branch.
  const std::complex<double> contrast(permittivity.real - 1.0, -permittivity.loss);
  const std::complex<double> q =
      std::sqrt(std::complex<double>(contrast.real() + cos_t * cos_t, contrast.imag()));
  const std::complex<double> sum_h = cos_t + q;
  const std::complex<double> sum_v = eps * cos_t + q;
  return {-contrast / sum_h / sum_h,
          contrast / sum_v * ((eps + 1.0) * (cos_t * cos_t) - 1.0) / sum_v};
}

double normal_reflectivity(const Permittivity& permittivity) {
  return std::norm(fresnel_reflection(permittivity, 0.0).vertical);
}

}  // namespace fanbeam::materials
