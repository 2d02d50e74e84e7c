// Reads a reflectivity model from a table of a material library or a row's `reference`.
//
//   model = "constant-gamma", terrain    kGammaTerrainNames
//   model = "kulemin", terrain           kKuleminTerrainNames
//   model = "git-land", terrain          kGitTerrainNames
//   model = "nrl-sea", sea_state         0 to 6
//   model = "oh1992", medium             a name of dielectric_medium.h; or permittivity = [real,
//                                        loss]; rms_height_mm, 0 to 1000; temperature_C, -50 to 60
//                                        and known to the medium, default 15 or the nearest
//   model = "rough-metal", rms_slope     0.01 to 1; rms_height_mm, 0 to 1000
//   model = "tabulated", grazing_deg     increasing, above 0 to 90; sigma0 (linear) or sigma0_dB,
//                                        as many; frequency_range_GHz; polarisation "HH", "VV",
//                                        "any"
//   model = "phong", a, b, c             and what material_library.h lists; the default
#pragma once

#include <optional>

#include "core/config_table.h"
#include "materials/library/phong_reference.h"
#include "materials/nrcs/surface_model.h"

namespace fanbeam::materials {

// Problems go to the table's list; what comes back then holds defaults. `model` is "phong" where
// the key is missing.
SurfaceModel read_surface_model(core::ConfigTable& table);

// The table `reference` of a Phong-like row, missing when it has none. Further keys: fit_angles
// (kFitAnglesNames), offset_dB (+-40), exponent_to_GHz.
std::optional<PhongReference> read_reference(core::ConfigTable& row);

}  // namespace fanbeam::materials
