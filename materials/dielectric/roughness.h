// How much coherent reflection the roughness of a surface costs.
//
//   coherent power factor exp(-(2 k s sin(psi))^2), k = 2 pi / lambda, for Gaussian heights
//
// s is the standard deviation of the surface height, psi the grazing angle. Source: Ament, Proc.
// IRE 41 (1953). Neglected: correlation length and shadowing; Ament's factor is too dark for k s
// sin(psi) above about 0.5 (Miller and Brown's is the remedy).
#pragma once

namespace fanbeam::materials {

// Multiplies |Gamma|^2 of the smooth surface; 1 at grazing or for s = 0. Heights >= 0, wavelength >
// 0, grazing 0 to pi/2, else InputError E-RANGE or E-NONFINITE.
double coherent_power_factor(double rms_height_m, double wavelength_m, double grazing_rad);

}  // namespace fanbeam::materials
