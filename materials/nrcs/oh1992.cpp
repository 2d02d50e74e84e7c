#include "materials/nrcs/oh1992.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/number_range.h"
#include "materials/dielectric/fresnel.h"

namespace fanbeam::materials {

OhNrcs oh1992_sigma0(const Permittivity& permittivity, double rms_height_m, double wavelength_m,
                     double grazing_rad) {
  check_permittivity(permittivity);
  core::require_range("rms_height_m", rms_height_m, {0.0, 1.0});
  core::require_range("wavelength_m", wavelength_m, {1e-6, 1e3});
  core::require_range("grazing_rad", grazing_rad, {-core::kPi / 2.0, core::kPi / 2.0});
  const double normal = normal_reflectivity(permittivity);
  const double ks = 2.0 * core::kPi / wavelength_m * rms_height_m;
  // A surface that is smooth or has no contrast scatters nothing; the limits of the formulas are
  // 0/0 there.
  if (grazing_rad <= 0.0 || ks == 0.0 || normal == 0.0) return {};

  const double incidence_rad = std::max(0.0, core::kPi / 2.0 - grazing_rad);
  const FresnelReflection gamma = fresnel_reflection(permittivity, incidence_rad);
  const double sqrt_p =
      1.0 - std::pow(2.0 * incidence_rad / core::kPi, 1.0 / (3.0 * normal)) * std::exp(-ks);
  const double q = 0.23 * std::sqrt(normal) * -std::expm1(-ks);
  const double cos_t = std::sin(grazing_rad);
  const double unpolarised = 0.7 * -std::expm1(-0.65 * std::pow(ks, 1.8)) * cos_t * cos_t * cos_t *
                             (std::norm(gamma.vertical) + std::norm(gamma.horizontal));
  const double vv = unpolarised / sqrt_p;
  return {unpolarised * sqrt_p, vv, q * vv};
}

}  // namespace fanbeam::materials
