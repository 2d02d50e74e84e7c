// Liquid water content of fog from the meteorological visibility, M = (c / V)^n, V in km.
//
//   name                c [km]       n       fog
//   kunkel (default)    3.912/144.7  1/0.88  any                     [1]
//   eldridge-altshuler  0.024        1.54    radiation, continental  [2]
//   zhao-radiation      1/42.0       1.54    radiation, inland       [3]
//   zhao-advection      1/18.35      1.43    advection, maritime     [3]
//   tomasi-dry-cold     0.034        1.5     dry and cold            [4]
//   tomasi-wet-warm     0.060        1.5     wet and warm            [4]
//
// [1] Kunkel 1984, J. Climate Appl. Met. 23, 34-41   [2] Eldridge 1966, used by Altshuler 1984
// [3] Zhao and Wu 2000, Int. J. IR MM Waves        [4] Tomasi and Tampieri 1976, Atmosphere 14, 61
//
// Kunkel inverts the extinction 144.7 M^0.88 per km with V = 3.912 / extinction (2 % contrast). It
// alone meets both figures of ITU-R P.840 (0.05 g/m3 at about 300 m, 0.5 at about 50 m).
// Confidence: the coefficients of Kunkel are verified; those of the other models are quoted from
// the literature without sight of the original.
// Accuracy: visibility does not fix the water content; fog types spread over a factor 3.5 to 5.
#pragma once

#include <string_view>

namespace fanbeam::atmosphere {

enum class FogWaterModel {
  kunkel,
  eldridge_altshuler,
  zhao_radiation,
  zhao_advection,
  tomasi_dry_cold,
  tomasi_wet_warm
};

// Names as in the table. Throws InputError E-REF for any other name.
FogWaterModel fog_water_model_named(std::string_view name);
std::string_view name_of(FogWaterModel model);

// g/m3; visibility 10 to 100000 m. Throws InputError: E-RANGE, E-NONFINITE.
double liquid_water_g_per_m3(FogWaterModel model, double visibility_m);

// The other way round, above 0 g/m3; below 10 m or beyond 100000 m the nearer of the two.
double visibility_m(FogWaterModel model, double liquid_water_g_per_m3);

}  // namespace fanbeam::atmosphere
