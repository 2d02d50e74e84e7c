// Fresnel reflection at a smooth plane boundary from air into a lossy medium.
//
//   Gamma_H = (cos t - q) / (cos t + q),   Gamma_V = (eps cos t - q) / (eps cos t + q),
//   q = sqrt(eps - sin^2 t), the root that decays into the medium; t is the incidence angle.
//
// Signs as usual in radar: at normal incidence Gamma_V = -Gamma_H, at grazing both tend to -1. Any
// textbook, for example Ulaby, Moore, Fung, Microwave Remote Sensing I (1981). The
// numerators are evaluated as (1 - eps) and (eps - 1)((eps + 1) cos^2 t - 1), which have no
// cancellation at grazing incidence or near Brewster's angle. Accuracy: 1e-12 absolute. Neglected:
// roughness (see roughness.h), layers.
#pragma once

#include <complex>

#include "materials/dielectric/permittivity.h"

namespace fanbeam::materials {

struct FresnelReflection {
  std::complex<double> horizontal;
  std::complex<double> vertical;
};

// Incidence 0 to pi/2; permittivity as check_permittivity demands; else InputError E-RANGE or
// E-NONFINITE.
FresnelReflection fresnel_reflection(const Permittivity& permittivity, double incidence_rad);

// |Gamma|^2 at normal incidence, the same for both polarisations.
double normal_reflectivity(const Permittivity& permittivity);

}  // namespace fanbeam::materials
