// Relative permittivity of building materials, water, ice and dry snow.
//
//   building materials  eps' = a f^b,  eps'' = 17.98 sigma / f,  sigma = c f^d S/m, f in GHz
//                       ITU-R P.2040-3 (2023), section 2.1.4, Table 3; asphalt concrete as listed
//                       by later transcriptions of the recommendation
//   pure water          double Debye relaxation, Liebe, Hufford and Manabe (1991)
//   pure ice            Maetzler, Thermal Microwave Radiation, IET 2006
//   dry snow            eps' = 1 + 1.7 rho + 0.7 rho^2, rho in g/cm3, no loss; Kendra, Sarabandi
//                       and Ulaby 1998
//
// Inputs outside the stated ranges throw InputError E-RANGE or E-NONFINITE: the ground rows of
// P.2040 end at 10 GHz and brick at 40 GHz, and no value is made up beyond. Neglected: moisture,
// salinity, impurities. Accuracy: published values of one material differ; concrete near 60 GHz is
// given as 4, 5.24 and 6.5.
#pragma once

#include <complex>

namespace fanbeam::materials {

// eps = real - j loss, for the time dependence exp(+j omega t); a passive medium has loss >= 0.
struct Permittivity {
  double real = 1.0;
  double loss = 0.0;

  // The sign of a zero imaginary part is kept negative: it decides the branch of square roots.
  std::complex<double> complex() const { return {real, -loss}; }
};

inline constexpr double kLargestPermittivity = 1e12;

// Throws InputError E-RANGE (real outside 1..1e12, loss outside 0..1e12: a negative loss would be
// gain) or E-NONFINITE.
void check_permittivity(const Permittivity& permittivity);

enum class BuildingMaterial {
  concrete,           // 1 to 100 GHz
  brick,              // 1 to 40 GHz
  plasterboard,       // 1 to 100 GHz
  wood,               // 0.001 to 100 GHz
  glass,              // 0.1 to 100 GHz
  marble,             // 1 to 60 GHz
  asphalt_concrete,   // 1 to 40 GHz
  metal,              // 1 to 100 GHz
  very_dry_ground,    // 1 to 10 GHz
  medium_dry_ground,  // 1 to 10 GHz
  wet_ground,         // 1 to 10 GHz
};

Permittivity building_permittivity(BuildingMaterial material, double frequency_Hz);

// 1 MHz to 1 THz, 253.15 to 333.15 K (below 273.15 K supercooled).
Permittivity water_permittivity(double frequency_Hz, double temperature_K);

// 10 MHz to 300 GHz, 240 to 273.15 K.
Permittivity ice_permittivity(double frequency_Hz, double temperature_K);

// Density 0 to 500 kg/m3.
Permittivity dry_snow_permittivity(double density_kg_per_m3);

}  // namespace fanbeam::materials
