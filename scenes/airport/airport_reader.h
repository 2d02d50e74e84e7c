// The airport of that name in whatever file of airports.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "scenes/airport/airport.h"

namespace fanbeam::scenes {

// read_runway_csv (runway_csv_reader.h) of files that end in .csv, read_apt_dat (apt_dat_reader.h) of all
// others.
std::optional<Airport> read_airport(const std::filesystem::path& file, const std::string& ident,
                                    core::ProblemList& problems);

}  // namespace fanbeam::scenes
