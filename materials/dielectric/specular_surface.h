// The mirror reflection of a rough dielectric surface: what a ground-bounce path keeps.
//
//   amplitude  Gamma(t) exp(-(2 k s sin(psi))^2 / 2),   power  |Gamma(t)|^2 exp(-(2 k s sin(psi))^2)
//
// Gamma is Fresnel's coefficient for the smooth boundary (fresnel.h), the exponential Ament's
// factor for Gaussian heights (roughness.h), s the rms height, psi the grazing angle, t = 90 deg -
// psi. Time dependence exp(+j omega t), so a path longer by d is delayed in phase by exp(-j k d).
// Neglected: the incoherent field around the mirror direction, shadowing, the divergence of a
// curved Earth, layers. Accuracy: Ament's factor is too dark for k s sin(psi) above about 0.5.
// Cost: two complex square roots and an exponential.
#pragma once

#include <complex>

#include "core/polarisation.h"
#include "materials/dielectric/permittivity.h"

namespace fanbeam::materials {

using core::Polarisation;

struct SpecularSurface {
  Permittivity permittivity;
  double rms_height_m = 0.0;

  bool operator==(const SpecularSurface&) const = default;
};

// Amplitude of the reflected field. Grazing 0 to pi/2, heights 0 to 1000 m, wavelength 1e-6 to
// 1e3 m, else InputError E-RANGE or E-NONFINITE; the same holds for the power.
std::complex<double> specular_reflection(const SpecularSurface& surface, Polarisation polarisation,
                                         double wavelength_m, double grazing_rad);

// |specular_reflection|^2, between 0 and 1.
double specular_power_reflection(const SpecularSurface& surface, Polarisation polarisation,
                                 double wavelength_m, double grazing_rad);

}  // namespace fanbeam::materials
