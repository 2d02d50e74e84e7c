// The reflectivity models by the names that the tables of tests/data use.
#pragma once

#include <map>
#include <string>

#include "core/polarisation.h"
#include "core/units.h"
#include "materials/nrcs/git_land.h"
#include "materials/nrcs/kulemin.h"
#include "materials/nrcs/nrl_sea.h"
#include "tests/data_rows.h"

namespace fanbeam::tests {

inline double nrl_sigma0(const DataRow& row) {
  return materials::nrl_sea_sigma0(row.text("polarisation").starts_with('H')
                                       ? core::Polarisation::horizontal
                                       : core::Polarisation::vertical,
                                   row.number("sea_state"), row.number("frequency_GHz") * 1e9,
                                   core::radians(row.number("grazing_deg")));
}

// Rows of nrcs_model_vectors.csv.
inline double modelled_sigma0(const DataRow& row) {
  using materials::GitTerrain;
  using materials::KuleminTerrain;
  static const std::map<std::string, KuleminTerrain> kKulemin = {
      {"concrete", KuleminTerrain::concrete},
      {"arable_land", KuleminTerrain::arable_land},
      {"snow", KuleminTerrain::snow},
      {"forest_summer", KuleminTerrain::forest_summer},
      {"grass_over_0.5m", KuleminTerrain::grass_above_half_metre},
      {"urban", KuleminTerrain::urban}};
  static const std::map<std::string, GitTerrain> kGit = {{"grass", GitTerrain::grass},
                                                         {"trees", GitTerrain::trees},
                                                         {"wet_snow", GitTerrain::wet_snow},
                                                         {"dry_snow", GitTerrain::dry_snow}};
  const double grazing_rad = core::radians(row.number("grazing_deg"));
  if (row.text("model") == "kulemin")
    return materials::kulemin_sigma0(kKulemin.at(row.text("terrain")),
                                     row.number("frequency_GHz") * 1e9, grazing_rad);
  if (row.text("model") == "git_land")
    return materials::git_land_sigma0(kGit.at(row.text("terrain")), materials::GitBand::ka_35GHz,
                                      grazing_rad);
  return nrl_sigma0(row);
}

}  // namespace fanbeam::tests
