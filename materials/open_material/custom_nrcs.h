// Measured or chosen reflectivity in the customProperties of a material: the standard has no place
// of its own for it. Keys of ours, all others in customProperties belong to other programs:
//
//   "customProperties": {
//     "fanbeam": {
//       "nrcs": [
//         { "frequency_GHz": 35, "a": 0.02, "b": 0.1, "c": 2.0, "frequency_exponent": 0.5,
//           "frequency_range_GHz": [30, 40], "polarisation": "HH", "source": "..." },
//         { "frequency_GHz": 76, "grazing_deg": [1, 5, 30, 90], "sigma0_dB": [-35, -26, -14, 0] }
//       ]
//     }
//   }
//
//   frequency_GHz        0.1 to 300, required
//   a, b, c              sigma0 = a sin(psi) + b sin(psi)^c; 0 to 1e6, b and c as in phong_nrcs.h
//   grazing_deg,         instead of a, b, c: a table as tabulated.h takes it, 1 to 1000 rows;
//   sigma0_dB            above 0 to 90 deg increasing; -200 to 60 dB
//   frequency_exponent   of a and b, default 0
//   frequency_range_GHz  where it is used, default 10 % to both sides
//   polarisation         "HH", "VV" or "any", the default
//   source               for people
//
// A single object may stand for an array of one.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "materials/nrcs/surface_model.h"
#include "materials/open_material/radar_query.h"

namespace fanbeam::materials {

struct CustomNrcs {
  SurfaceModel surface;
  double frequency_Hz = 35e9;
  std::optional<core::Polarisation> polarisation;
};

// Of the entries that know the radar's frequency and polarisation, the one nearest in frequency;
// between equals one of that polarisation before one for any.
const CustomNrcs* best_of(const std::vector<CustomNrcs>& entries, const RadarQuery& query);

}  // namespace fanbeam::materials
