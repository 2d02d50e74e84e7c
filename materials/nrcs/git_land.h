// Georgia Tech (GIT) land reflectivity.
//
//   sigma0 = A (psi + C)^B        psi in radians
//
// Source: the tables in Currie, "Clutter Characteristics and Effects" (Eaves and Reedy, Principles
// of Modern Radar, 1987) and Long; recalled, not checked. The factor exp(-D / (1 + 0.1 sigma_h /
// lambda)) of the full model is 1 for every terrain held here (D = 0), so neither surface height
// nor wavelength enters; soil, the one terrain with D > 0, is left out because its A is recalled as
// 0.25 and as 0.025. Bands of 10, 35 and 95 GHz. Between two bands sigma0 in dB is a straight line
// over the logarithm of frequency; that line is ours, not the source's. Grazing angles roughly 1 to
// 60 deg; at psi = 0 the model has a floor A C^B. Polarisation is not told apart. Accuracy: a
// terrain class spreads by +-5 dB; how sure we are of each row: docs/physics/git-land.md.
#pragma once

#include <array>
#include <string_view>

#include "materials/interval.h"

namespace fanbeam::materials {

enum class GitTerrain {
  grass,
  tall_grass_crops,
  trees,
  wet_snow,
  dry_snow,
  urban,  // 10 GHz only
};
enum class GitBand { x_10GHz, ka_35GHz, w_95GHz };

// As files name them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> kGitTerrainNames = {
    "grass", "tall-grass-crops", "trees", "wet-snow", "dry-snow", "urban"};

// From the lowest to the highest band that has a row for the terrain.
Interval git_land_frequency_Hz(GitTerrain terrain);

// Zero at negative grazing angles (back faces). Throws InputError E-RANGE for a band without a row,
// or a frequency outside git_land_frequency_Hz.
double git_land_sigma0(GitTerrain terrain, GitBand band, double grazing_rad);
double git_land_sigma0(GitTerrain terrain, double frequency_Hz, double grazing_rad);

}  // namespace fanbeam::materials
