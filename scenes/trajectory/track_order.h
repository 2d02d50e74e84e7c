// Private to the flight paths: which rows of a recording are out of order, and how rows are left
// out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

core::Place place_of(const RawTrack& track, const TrackRow& row);

// To a tenth, or to one of `parts`, without a negative zero.
std::string rounded_text(double value, double parts = 10.0);

// "row 57", or "rows 57 to 59".
std::string rows_text(std::int64_t first, std::int64_t last);

// Leaves out the rows of these indices, which increase, and lists them with their reasons.
struct LeftOut {
  std::size_t index = 0;
  std::string why;
};
void leave_out(RawTrack& track, const std::vector<LeftOut>& rows);

// The fewest rows without which times increase, in O(n log n); of two answers the one that keeps
// earlier rows. So one clock reading that is too late is blamed itself, not all that follow.
std::vector<std::size_t> rows_out_of_order(const std::vector<TrackRow>& rows);

// E-TIME for each of them, or leaves them out under OutlierPolicy::reject.
void bring_into_order(RawTrack& track, const TrajectoryColumns& columns,
                      core::ProblemList& problems);

}  // namespace fanbeam::scenes
