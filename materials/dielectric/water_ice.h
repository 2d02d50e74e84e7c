// Relative permittivity of pure water and pure ice.
//
//   water  double Debye relaxation, Liebe, Hufford and Manabe, Int. J. Infrared Millim. Waves 12
//          (1991); the same curve as ITU-R P.527-4 for pure water
//   ice    Maetzler, in Thermal Microwave Radiation, IET (2006)
//
// Inputs outside the ranges below throw InputError E-RANGE or E-NONFINITE. Neglected: salt and
// other impurities, which matter to water below about 10 GHz and to the loss of ice everywhere.
// Accuracy: the static permittivity of water at 25 C is 78.48 against 78.36 measured; ice agrees
// between three independent transcriptions. Cost: a complex division; two exponentials.
#pragma once

#include "materials/dielectric/permittivity.h"
#include "materials/interval.h"

namespace fanbeam::materials {

inline constexpr Interval kWaterFrequencies_Hz{1e6, 1e12};
inline constexpr Interval kIceFrequencies_Hz{10e6, 300e9};

// 253.15 to 333.15 K (below 273.15 K supercooled).
Permittivity water_permittivity(double frequency_Hz, double temperature_K);

// 240 to 273.15 K.
Permittivity ice_permittivity(double frequency_Hz, double temperature_K);

}  // namespace fanbeam::materials
