// Relative permittivity of moist soil from texture, density, moisture and temperature.
//
//   eps'  = [1 + (rb/rs)(es^a - 1) + m^b1 ew'^a - m]^(1/a),   a = 0.65
//   eps'' = [m^b2 ew''^a]^(1/a)
//   es = (1.01 + 0.44 rs)^2 - 0.062
//   b1 = 1.2748 - 0.519 S - 0.152 C,   b2 = 1.33797 - 0.603 S - 0.166 C
//   ew'' = water'' + (18 / f) sigma (rs - rb) / (rs m),  ew' = water'
//   sigma = -1.645 + 1.939 rb - 2.25622 S + 1.594 C
//
// rb is the dry bulk density and rs the density of the grains in g/cm3, S and C the mass fractions
// of sand and clay, m the volumetric moisture, f in GHz; water is pure water at the soil's
// temperature (water_ice.h). Source: Dobson, Ulaby, Hallikainen, El-Rayes, IEEE Trans. Geosci.
// Remote Sens. 23(1), 35-46 (1985), with the conductivity that its authors give above 1.4 GHz and
// the water of ITU-R P.527-4 to -6, whose soil model is the same. The recommendation's further
// term, which blends to another conductivity below 1.35 GHz, is left out: it changes eps by up to
// 6 % at 4 GHz, 0.8 % at 10 GHz and 0.1 % at 35 GHz. All coefficients were compared with public
// transcriptions of both, not with the documents themselves.
//
// Inputs outside the stated ranges throw InputError E-RANGE or E-NONFINITE. Neglected: salt, bound
// water, organic matter, frost, layers and stones. A negative free-water conductivity, which the
// regression gives for sandy soils, is taken as it comes as long as the water keeps a loss; the
// smallest loss is 0. Accuracy: measured soils at 4 to 18 GHz lie within about 10 % of eps'; above
// 18 GHz it is the authors' extrapolation to 37 GHz. Cost: five powers.
#pragma once

#include "materials/dielectric/permittivity.h"
#include "materials/interval.h"

namespace fanbeam::materials {

inline constexpr Interval kSoilFrequencies_Hz{4e9, 37e9};

struct Soil {
  double sand_mass_fraction = 0.4196;  // sand and clay 0 to 1, together at most 1
  double clay_mass_fraction = 0.0853;
  double bulk_density_kg_per_m3 = 1578.1;   // 800 to 2000, of the dried soil
  double grain_density_kg_per_m3 = 2700.0;  // 2500 to 2800
  double moisture_volume_fraction = 0.2;    // 0.01 to 0.5
};

// 273.15 to 313.15 K.
Permittivity soil_permittivity(const Soil& soil, double frequency_Hz, double temperature_K);

}  // namespace fanbeam::materials
