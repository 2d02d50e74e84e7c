// Backscatter of a material from a BRDF table (`_brdf.xompt`) of ASAM OpenMATERIAL 3D 1.0 and 1.1.
//
//   sigma0 = 4 pi f_r cos^2(t)
//
// at equal incidence and exit angle t on the same side of the normal: f_r relates radiance to
// irradiance, sigma0 is 4 pi times the intensity per area and incident flux density, and both the
// irradiance and the projected area carry a cosine. Derivation: docs/physics/open-material.md.
//
// Rows: wavelength m, incident zenith rad, exit zenith rad, exit azimuth rad relative to incidence,
// f_r 1/sr. Of the wavelength nearest to the radar's, which is at most 10 % off it, the rows in the
// backscatter direction count: zenith angles equal and azimuth 0 or 2 pi, within 0.001 rad; at the
// normal every azimuth. Rows with a null are passed over. Between the rows f_r is linear in t,
// beyond the first and the last it is held. A BRDF of this standard does not know polarisation: it
// stands for HH and VV alike. Neglected: the solid angle of the receiver that measured it.
#pragma once

#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "materials/nrcs/surface_model.h"
#include "materials/open_material/radar_query.h"

namespace fanbeam::materials {

class BrdfTable {
 public:
  // Problems as PermittivityTable::from_file.
  static BrdfTable from_file(const std::filesystem::path& file, core::ProblemList& problems);

  // A table over the grazing angle in steps of a degree and finer at grazing.
  Lookup<TabulatedSurface> backscatter_at(const RadarQuery& query) const;

 private:
  struct Row {
    double wavelength_m = 0.0;
    double zenith_rad = 0.0;
    double brdf_per_sr = 0.0;
  };
  std::vector<Row> rows_;  // of the backscatter direction, by wavelength and angle
};

}  // namespace fanbeam::materials
