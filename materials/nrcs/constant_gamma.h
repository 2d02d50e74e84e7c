// Constant-gamma reflectivity: sigma0 = gamma sin(psi), psi the local grazing angle.
//
// The gammas are those published for 10 GHz in the source of MathWorks' `surfacegamma` (its
// comments cite Nathanson 1999 and Long 2001); they grow by 5 log10(f / 10 GHz) dB, a rule of thumb
// at millimetre waves. The Phong-like form with b = 0 is the same law. Neglected: shadowing below
// about 1 degree, the rise near vertical incidence, polarisation. Accuracy: a terrain class spreads
// by +-5 dB.
#pragma once

#include <array>
#include <string_view>

namespace fanbeam::materials {

enum class GammaTerrain {
  flatland,
  farmland,
  woods,
  wooded_hill,
  metropolitan,
  rugged_mountain,
  sea_state_3,
  sea_state_5,
};

// As files name them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 8> kGammaTerrainNames = {
    "flatland",     "farmland",        "woods",       "wooded-hill",
    "metropolitan", "rugged-mountain", "sea-state-3", "sea-state-5"};

inline constexpr double kGammaLowest_Hz = 1e9;
inline constexpr double kGammaHighest_Hz = 100e9;

// Linear gamma. Frequency 1 to 100 GHz, else InputError E-RANGE.
double gamma_at(GammaTerrain terrain, double frequency_Hz);

// Zero at grazing angles of zero and below (back faces).
double constant_gamma_sigma0(double gamma, double grazing_rad);

}  // namespace fanbeam::materials
