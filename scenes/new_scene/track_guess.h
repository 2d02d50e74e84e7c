// How a recorded flight of somebody's own table is to be read, and which part of it is the approach.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"
#include "scenes/new_scene/note.h"
#include "scenes/new_scene/track_columns.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// The landing that the flight is held against. Heights are above mean sea level.
struct TrackReference {
  core::Geodetic threshold;
  double bearing_rad = 0.0;
  double runway_length_m = 0.0;  // behind the threshold
  double runway_slope = 0.0;     // rise per metre in landing direction
  double geoid_m = 0.0;          // of mean sea level above the ellipsoid there
  double threshold_crossing_height_m = 15.0;
  double start_distance_m = 5000.0;  // where the scene shall begin
  // Nothing where there are no elevation data.
  std::function<std::optional<double>(const core::Geodetic&)> ground_m;
};

struct TrackGuess {
  TrajectoryColumns columns;  // with units, height offset and the approach's times
  core::VerticalDatum datum = core::VerticalDatum::egm96;
  std::vector<core::Geodetic> path;  // of the approach
};

// A height is the same approach in four readings: metres or feet, from mean sea level or from the
// ellipsoid. What a column's name says is believed; of the rest that reading is taken in which a
// straight line through the approach's last 5 km comes nearest to the threshold crossing height.
// Heights by pressure also get the offset that brings them there.
//
// Rows on the ground are left out at both ends; what goes around after a landing ends with that. Of a flight that
// is no approach and stands on the ground in between, three rows or 3 s, the longest piece in the air is taken.
//
// What is not readable as a flight, with its line: E-IO, E-PARSE for columns that no name tells and
// for times in an unknown form; E-RANGE for a flight that never comes within the start distance of
// the threshold or not over the elevation data, with a word when its latitudes and longitudes are
// exchanged, or has no two rows in the air there. Rows with cells that are no numbers are passed over
// here: whoever reads the whole file judges them.
std::optional<TrackGuess> guess_track(const std::filesystem::path& file,
                                      const TrackReference& reference, Notes& notes,
                                      core::ProblemList& problems);

}  // namespace fanbeam::scenes
