// When a surface is smooth to a radar, and how much coherent reflection its roughness costs.
//
//   Rayleigh criterion     8 s sin(psi) < lambda       phase error below 90 deg
//   Fraunhofer criterion  32 s sin(psi) < lambda       the stricter one, below 22.5 deg
//   coherent power factor exp(-(2 k s sin(psi))^2), k = 2 pi / lambda, for Gaussian heights
//
// s is the standard deviation of the surface height, psi the grazing angle. Source: Ulaby, Moore,
// Fung, Microwave Remote Sensing II (1982), recalled; Ament, Proc. IRE 41 (1953) for
// the factor. Neglected: correlation length and shadowing; Ament's factor is too dark for k s
// sin(psi) above about 0.5 (Miller and Brown's is the remedy).
#pragma once

namespace fanbeam::materials {

bool is_smooth_rayleigh(double rms_height_m, double wavelength_m, double grazing_rad);
bool is_smooth_fraunhofer(double rms_height_m, double wavelength_m, double grazing_rad);

// Multiplies |Gamma|^2 of the smooth surface; 1 at grazing or for s = 0. Heights >= 0, wavelength >
// 0, grazing 0 to pi/2, else InputError E-RANGE or E-NONFINITE; the same holds for the two
// criteria.
double coherent_power_factor(double rms_height_m, double wavelength_m, double grazing_rad);

}  // namespace fanbeam::materials
