// A runway of which nothing but its two ends is known.
#pragma once

#include <optional>
#include <string>

#include "core/errors.h"
#include "scenes/airport/airport.h"

namespace fanbeam::scenes {

struct RunwayEnds {
  std::string airport, runway;  // its ident, and the designator of who lands
  // LAT,LON or LAT,LON,HEIGHT_M, as "47.6660,9.4979,406.6": degrees, and metres above mean sea level from
  // -500 to 6000.
  std::string threshold, far_end;
  double width_m = 0.0;  // 0 where it is not known
};

// Nothing after an error: E-RANGE of --threshold, --far-end and --runway.
std::optional<Airport> airport_from_ends(const RunwayEnds& told, core::ProblemList& problems);

}  // namespace fanbeam::scenes
