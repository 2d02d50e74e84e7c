// Finds the asked columns in the header line of a table in text form.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// The cells of a line, without blanks and quotes around them. Views into `line`.
void split_cells(std::string_view line, std::vector<std::string_view>& cells);

// What the column's numbers count in: as stated, else the text behind the last underscore of its
// name.
std::string_view unit_of(const TrajectoryColumn& column);

// A quantity's cell in every row and what turns it into SI.
struct TrackCell {
  std::string_view name;
  std::size_t index = 0;
  double scale = 1.0;
  double lowest = 0.0;  // SI
  double highest = 0.0;
  const char* expected = "";  // the range in words
  bool is_iso8601 = false;    // a date and time (iso_time.h) instead of a number
};

struct TrackCells {
  TrackCell time;
  std::array<TrackCell, 3> position;                 // latitude, longitude, height
  std::array<std::optional<TrackCell>, 3> attitude;  // roll, pitch, heading
  std::size_t cells_per_row = 0;
};

// Adds E-PARSE to `problems` for every column that is missing, doubled, or of an unknown unit.
// The names inside the result are those of `columns`.
TrackCells find_track_cells(const std::vector<std::string_view>& header,
                            const TrajectoryColumns& columns, const core::Place& place,
                            core::ProblemList& problems);

}  // namespace fanbeam::scenes
