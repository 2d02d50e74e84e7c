#include "materials/dielectric/specular_surface.h"

#include <cmath>

#include "core/constants.h"
#include "materials/dielectric/fresnel.h"
#include "materials/dielectric/roughness.h"

namespace fanbeam::materials {

std::complex<double> specular_reflection(const SpecularSurface& surface, Polarisation polarisation,
                                         double wavelength_m, double grazing_rad) {
  const double power_factor =
      coherent_power_factor(surface.rms_height_m, wavelength_m, grazing_rad);
  const FresnelReflection gamma =
      fresnel_reflection(surface.permittivity, core::kPi / 2.0 - grazing_rad);
  return std::sqrt(power_factor) *
         (polarisation == Polarisation::horizontal ? gamma.horizontal : gamma.vertical);
}

double specular_power_reflection(const SpecularSurface& surface, Polarisation polarisation,
                                 double wavelength_m, double grazing_rad) {
  return std::norm(specular_reflection(surface, polarisation, wavelength_m, grazing_rad));
}

}  // namespace fanbeam::materials
