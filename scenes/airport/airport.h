// An airport's runways as public data tell them, whatever file they came from, and the choice of
// one of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"
#include "scenes/airport/apt_dat_outline.h"
#include "scenes/airport/runway_surface.h"

namespace fanbeam::scenes {

struct AirportRunwayEnd {
  std::string name;                   // "06", "24R": the designator of a landing on this end
  core::Geodetic pavement_end;        // its height is not used
  std::optional<double> elevation_m;  // above mean sea level
  double displaced_m = 0.0;           // of the threshold, inwards
  std::optional<bool> approach_lights;
};

struct AirportRunway {
  AirportRunwayEnd ends[2];
  double width_m = 0.0;  // 0 where the data do not say
  RunwaySurface surface;
  std::optional<bool> edge_lights, markings, shoulders;  // nothing where the data do not say
  core::Place place;
};

// Taxiways and aprons: the outline, then holes.
struct AirportPavement {
  RunwaySurface surface;
  std::vector<AirportLine> rings;
  core::Place place{};
};

// A precision approach path indicator: the middle of its bar, and the heading of who lands.
struct AirportPapi {
  core::Geodetic at;
  double heading_rad = 0.0;
};

struct Airport {
  std::string ident;                  // as in the file
  std::string name;                   // may be empty; any text
  std::optional<double> elevation_m;  // above mean sea level
  std::vector<AirportRunway> runways;
  std::vector<AirportPavement> pavements;   // of apt.dat alone, and so are the rest
  std::vector<AirportLine> taxiway_lights;  // along which they stand
  std::vector<AirportPapi> papis;
  std::size_t other_aids = 0;  // VASI, wig-wag and their like
  core::Place place;
};

// Whether two names of airports are the same but for the case of their letters.
bool is_same_ident(std::string_view a, std::string_view b);
// Whether two designators say the same: "6" and "06", "24r" and "24R".
bool is_same_runway(std::string_view a, std::string_view b);
// "24R" for "06L"; empty for what is no designator (01 to 36, with L, C, R, or any other letter).
std::string reciprocal_runway(std::string_view name);
// The nominal magnetic bearing that a designator stands for, 10 to 360 deg; nothing as above.
std::optional<double> designated_bearing_deg(std::string_view name);

// "edny-24": a scene's usual name for a landing there.
std::string landing_name(const std::string& ident, const std::string& runway);

// Adds that there is no airport of this name at `place`, with those that look like it.
void report_unknown_airport(const std::string& ident, const std::vector<std::string>& known,
                            const core::Place& place, core::ProblemList& problems);

// E-RANGE at `place` where the displaced thresholds of both ends leave less than 100 m of the
// pavement to land on.
void check_displaced(double both_m, double length_m, const core::Place& place,
                     core::ProblemList& problems);

struct Landing {
  AirportRunway runway;
  int end = 0;               // of `runway`, that is landed on
  double bearing_rad = 0.0;  // true
  double length_m = 0.0;     // of the pavement

  const AirportRunwayEnd& threshold_end() const { return runway.ends[end]; }
  const AirportRunwayEnd& far_end() const { return runway.ends[1 - end]; }
};

// The landing on the end of that name. E-REF when there is none, with the airport's runways;
// E-RANGE for ends less than 100 m or more than 10 km apart, ends that lie the other way round than
// the designator says, and displaced thresholds beyond the pavement. W-BEARING where the ends lie
// more than 40 deg off the designator, which magnetic variation explains in few places.
std::optional<Landing> choose_landing(const Airport& airport, const std::string& runway,
                                      core::ProblemList& problems);

}  // namespace fanbeam::scenes
