// Runways from a table in text form, in either of two layouts, told apart by their header lines:
//
//   a row per runway, as OurAirports publishes it (runways.csv, public domain): airport_ident,
//   width_ft, surface, lighted, closed, and for the lower end le_ident, le_latitude_deg,
//   le_longitude_deg, le_elevation_ft, le_displaced_threshold_ft, for the higher end he_...
//
//   a row per end, in SI units: airport, runway_end, end_lat_deg, end_lon_deg, displaced_threshold_m,
//   end_elevation_m_msl, width_m, surface, lighted. Rows whose names are reciprocal (06L and 24R)
//   are the ends of one runway.
//
// Other columns are not looked at. Positions are WGS 84, of the ends of the pavement; elevations
// count from mean sea level and may be empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "scenes/airport/airport.h"

namespace fanbeam::scenes {

// The airport's open runways that have two ends with coordinates. Adds to `problems`, with lines:
//   E-IO, E-LIMIT  as LineReader; more than kMostAirportRunways
//   E-PARSE        a header of neither layout, a missing column, another number of cells than the
//                  header has, not a number
//   E-NONFINITE, E-RANGE  a number that no runway has
//   E-REF          no such airport, with names that look like it; one without a runway that is
//                  open and has coordinates
//   W-SKIPPED      runways that are closed or have no coordinates
// Only rows of the airport asked for are checked. Nothing after an error.
std::optional<Airport> read_runway_csv(const std::filesystem::path& file, const std::string& ident,
                                       core::ProblemList& problems);

}  // namespace fanbeam::scenes
