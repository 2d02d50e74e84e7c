// Sea reflectivity after Gregers-Hansen and Mital.
//
//   sigma0_dB = c1 + c2 log10 sin(psi) + (27.5 + c3 psi) log10(f) / (1 + 0.95 psi)
//               + c4 (1 + S)^(1 / (2 + 0.085 psi + 0.033 S)) + c5 psi^2
//   psi in degrees, f in GHz, S the sea state (Douglas)
//
// Source: V. Gregers-Hansen, R. Mital, "An Improved Empirical Model for Radar Sea Clutter
// Reflectivity", NRL/MR/5310--12-9346 (2012). The coefficients carry the digit more that the
// authors' code has over the table. Inputs: 0.5 to 35 GHz and sea state 0 to 6, else InputError
// E-RANGE or E-NONFINITE; grazing 0.1 to 60 deg, outside of which the formula is extrapolated.
// Averaged over wind direction. Not valid at 76 or 94 GHz. Accuracy: mean deviation from
// Nathanson's tables 2.6 dB; at 35 GHz 2.8 dB (HH), 3.3 dB (VV), at most 11 dB.
#pragma once

#include "core/polarisation.h"

namespace fanbeam::materials {

using core::Polarisation;

inline constexpr double kNrlSeaLowest_Hz = 0.5e9;
inline constexpr double kNrlSeaHighest_Hz = 35e9;

// Zero at grazing angles of zero and below.
double nrl_sea_sigma0(Polarisation polarisation, double sea_state, double frequency_Hz,
                      double grazing_rad);

}  // namespace fanbeam::materials
