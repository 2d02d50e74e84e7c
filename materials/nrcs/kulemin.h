// Kulemin's land reflectivity at millimetre waves.
//
//   sigma0_dB = A1 + A2 log10(psi / 20 deg) + A3 log10(f / 10 GHz)
//
// Source: G. P. Kulemin, Millimeter-Wave Radar Targets and Clutter, Artech House 2003, land NRCS
// table. The coefficients are recalled, not checked against the book; they are used as fit
// references and marked so. Valid for 3 to 100 GHz and grazing angles up to 30 deg; above that the
// formula is extrapolated. Neglected: polarisation, season other than the two forest rows,
// moisture. Spread of a class: about +-5 dB; the concrete row lies 14 dB (HH) to 21 dB (mean
// of HH and VV) under fits to Oh's surface model at 3 deg, see docs/materials.md.
#pragma once

#include <array>
#include <string_view>

namespace fanbeam::materials {

enum class KuleminTerrain {
  concrete,
  arable_land,
  snow,
  forest_summer,
  forest_deciduous_winter,
  grass_above_half_metre,
  grass_below_half_metre,  // middle of the published interval of A1, -30 to -25 dB
  urban,
};

// As files name them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 8> kKuleminTerrainNames = {"concrete",
                                                                         "arable-land",
                                                                         "snow",
                                                                         "forest-summer",
                                                                         "forest-winter",
                                                                         "grass-above-half-metre",
                                                                         "grass-below-half-metre",
                                                                         "urban"};

inline constexpr double kKuleminLowest_Hz = 3e9;
inline constexpr double kKuleminHighest_Hz = 100e9;

// Zero at grazing angles of zero and below. Frequency 3 to 100 GHz, else InputError E-RANGE.
double kulemin_sigma0(KuleminTerrain terrain, double frequency_Hz, double grazing_rad);

}  // namespace fanbeam::materials
