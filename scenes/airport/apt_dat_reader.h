// Runways from X-Plane's apt.dat.
//
// Read are formats 850 to 1200 ("Airport Data (apt.dat) File Specification", Laminar Research): of
// the airport asked for the header (row 1), its other names (row 1302) and its land runways (row
// 100). Ends are those of the pavement, without blast pads; the file has no elevations but the
// airport's. Row 100 with 26 fields: code, width in m, surface, shoulder, roughness, centre line
// lights, edge lights, distance signs, and for each end name, latitude, longitude, displaced
// threshold in m, blast pad in m, markings, approach lights, touchdown zone lights, identifier
// lights. Beside them pavements (row 110) and lines (row 120) with their corners (apt_dat_outline.h), of lines
// the lights of taxiway edges alone, and PAPI (row 21, types 2 and 3). A file of the whole world (400 MB) is read line by line and never held in memory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "scenes/airport/airport.h"

namespace fanbeam::scenes {

inline constexpr std::size_t kMostAirportRunways = 100;
inline constexpr std::size_t kMostAirportRows = 200'000;   // of pavements, lines and aids
inline constexpr std::size_t kMostAirportNames = 200'000;  // remembered for suggestions

// The airport whose row 1, or whose ICAO, IATA, FAA or local code (row 1302), is `ident`, whatever
// the case of its letters; the first of that name. Adds to `problems`, each with its line:
//   E-IO, E-LIMIT  as LineReader; more than kMostAirportRunways
//   E-PARSE        no apt.dat, or of another format; a row with too few fields; not a number
//   E-NONFINITE, E-RANGE  a number that no runway has
//   E-REF          no such airport, with names that look like it; one without land runways
//   W-SKIPPED      a ring of a pavement, or a line, that no row ends; a pavement without a ring
// Only rows of the airport asked for are checked. Nothing after an error.
std::optional<Airport> read_apt_dat(const std::filesystem::path& file, const std::string& ident,
                                    core::ProblemList& problems);

}  // namespace fanbeam::scenes
