// Georgia Tech (GIT) land reflectivity.
//
//   sigma0 = A (psi + C)^B        psi in radians
//
// Source: the tables in Currie, "Clutter Characteristics and Effects" (Eaves and Reedy, Principles
// of Modern Radar, 1987) and Long; recalled, not checked. The factor exp(-D / (1 + 0.1 sigma_h /
// lambda)) of the full model is 1 for every terrain held here (D = 0), so neither surface height
// nor wavelength enters. Valid at the band of the row; grazing angles roughly 1 to 60 deg. At psi =
// 0 the model has a floor A C^B. Confidence: medium at 35 GHz for grass, trees and wet snow, low
// for dry snow and for everything at 95 GHz.
#pragma once

namespace fanbeam::materials {

enum class GitTerrain { grass, tall_grass_crops, trees, wet_snow, dry_snow };
enum class GitBand { ka_35GHz, w_95GHz };

// Zero at negative grazing angles (back faces).
double git_land_sigma0(GitTerrain terrain, GitBand band, double grazing_rad);

}  // namespace fanbeam::materials
