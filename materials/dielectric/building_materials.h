// Relative permittivity of building materials and of paved and natural ground.
//
//   eps' = a f^b,  eps'' = 17.98 sigma / f,  sigma = c f^d S/m,  f in GHz
//
// ITU-R P.2040-3 (2023), section 2.1.4, Table 3; the row of asphalt concrete as later
// transcriptions of the recommendation list it. Each row has its own frequencies, and outside them
// InputError E-RANGE or E-NONFINITE is thrown: the ground rows end at 10 GHz, brick and asphalt at
// 40 GHz, and no value is made up beyond. Neglected: moisture, temperature, anisotropy, and the
// spread between samples of one material. Accuracy: concrete near 60 GHz is published as 4, 5.24
// (this model) and 6.5, which is 0.11 to 0.19 in reflected power; asphalt at 7 to 17 GHz as 5.0 to
// 5.3 against 4.83 here. Cost: two powers.
#pragma once

#include "materials/dielectric/permittivity.h"
#include "materials/interval.h"

namespace fanbeam::materials {

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

Interval building_frequencies_Hz(BuildingMaterial material);

}  // namespace fanbeam::materials
