// The rows of a flight's table before it is known how to read its heights.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/new_scene/track_columns.h"

namespace fanbeam::scenes {

struct TrackTable {
  static constexpr std::size_t kMostHeights = 4;
  struct Row {
    double time_s = 0.0;
    double latitude = 0.0, longitude = 0.0;     // as in the file
    std::array<double, kMostHeights> height{};  // as in the file; NaN where there is none
  };

  NamedColumns columns;
  std::string time_unit;  // "s", "ms" or "iso8601"
  std::string time_why;
  std::vector<Row> rows;  // those with a time and a position
  core::Place header;
};

// Nothing after E-IO, E-LIMIT (as LineReader, more than kMostTrackRows), or E-PARSE: a table of
// other than commas, no row, columns that no name tells with the names that are there, times that
// are neither numbers nor dates of ISO 8601.
std::optional<TrackTable> read_track_table(const std::filesystem::path& file,
                                           core::ProblemList& problems);

}  // namespace fanbeam::scenes
