// The part of a recorded flight that is an approach to a given runway end.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geodetic.h"

namespace fanbeam::scenes {

// A row of the flight seen from the threshold.
struct ApproachRow {
  double time_s = 0.0;
  core::Geodetic position;  // its height is not used
  double before_m = 0.0;    // along the centre line, before the threshold; negative behind it
  double left_m = 0.0;      // of the centre line, as seen on landing
  bool over_terrain = false;
};

// first <= last, indices of rows.
struct ApproachPart {
  std::size_t first = 0, last = 0;
};

// Every part that comes down to the threshold: over the terrain and near the centre line (within
// 300 m plus 15 % of the distance), without a pause of two minutes, from `start_distance_m` or as
// far as that holds, but at least 1 km, to the threshold or, where the recording ends before, to
// its end, and on to the end of the runway. In the order of time.
std::vector<ApproachPart> find_approaches(const std::vector<ApproachRow>& rows,
                                          double start_distance_m, double runway_length_m);

// Where there is none: the rows around the one nearest to the threshold that are over the terrain
// and within the start distance all around. Nothing for less than two.
std::optional<ApproachPart> find_nearest_part(const std::vector<ApproachRow>& rows,
                                              double start_distance_m);

// Height above the threshold's level at the threshold, of a straight line through heights at
// distances before it: medians of slopes and of offsets (Theil and Sen), so that single wrong
// values do not matter. Of one value it is that value.
double height_at_threshold_m(const std::vector<double>& before_m,
                             const std::vector<double>& height_m);

}  // namespace fanbeam::scenes
