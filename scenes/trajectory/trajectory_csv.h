// Reads a recorded flight from a table in text form.
//
// One header line, then one row per instant; cells separated by commas, quotes around a cell
// allowed. A byte order mark, CRLF line ends, blank lines and lines beginning with '#' are fine.
// Numbers use a decimal point whatever the locale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"
#include "scenes/trajectory/rejected_rows.h"

namespace fanbeam::scenes {

// Where one quantity is found.
struct TrajectoryColumn {
  std::string name;
  // Time: "s", "ms", "iso8601" (dates and times, see iso_time.h; the file's clock is then seconds
  // since 1970). Angles: "deg", "rad". Height: "m", "ft". Empty: the part of `name` behind its last
  // underscore.
  std::string unit;
  // A quantity that may be missing counts as not recorded; a missing other one is E-PARSE.
  bool may_be_missing = false;
};

// What to read from a file. The defaults are fanbeam's own form.
struct TrajectoryColumns {
  TrajectoryColumn time{"time_s", "", false};
  TrajectoryColumn latitude{"latitude_deg", "", false};
  TrajectoryColumn longitude{"longitude_deg", "", false};
  TrajectoryColumn height{"height_m", "", false};
  TrajectoryColumn roll{"roll_deg", "", true};
  TrajectoryColumn pitch{"pitch_deg", "", true};
  TrajectoryColumn heading{"heading_deg", "", true};  // true, not magnetic

  double height_offset_m = 0.0;  // added to every height, -20000 to 20000

  // Only rows inside both windows are read, ends included. Rows outside are not checked, but for
  // the time of those that the row window lets through. Times are seconds of the file's own clock;
  // rows count from 1 behind the header.
  std::optional<double> from_time_s;
  std::optional<double> to_time_s;
  std::optional<std::int64_t> first_row;
  std::optional<std::int64_t> last_row;

  OutlierPolicy outliers = OutlierPolicy::error;
};

// Longitude and heading as in the file; heights from whatever the file's heights count from.
// Angles that were not recorded are 0.
struct TrackRow {
  double time_s = 0.0;
  core::Geodetic position;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double heading_rad = 0.0;
  std::int32_t row = 0;  // counted from 1 behind the header; 0 when it is from no file
  std::int32_t line = 0;
};

// A flight as recorded: times increase, everything is finite and in range.
struct RawTrack {
  std::vector<TrackRow> rows;
  bool has_roll = false;
  bool has_pitch = false;
  bool has_heading = false;
  std::string file;
  std::vector<RejectedRows> rejected;  // under OutlierPolicy::reject

  bool fully_recorded() const { return has_roll && has_pitch && has_heading; }
};

// Most rows that one track may keep: 18 hours at 60 Hz, 256 MB. A longer file can be read through
// a window; the file itself is never held in memory.
inline constexpr std::size_t kMostTrackRows = 4'000'000;

// Adds to `problems` everything that is wrong, with its line; where that holds an error, the track
// returned must not be used.
//   E-IO       file cannot be read
//   E-PARSE    no header or no row; a column missing or there twice; another number of cells than
//              the header has ("1,5" makes two cells); not a number, or one that a double cannot
//              hold (1e400); an unknown unit
//   E-NONFINITE  nan or inf
//   E-RANGE    latitude beyond +-90 deg, longitude beyond +-540 deg, height outside -20 to 1000 km,
//              roll beyond +-180, pitch beyond +-90, heading beyond +-540 deg
//   E-TIME     a row out of order: the fewest rows without which times increase. With
//              OutlierPolicy::reject they are left out instead
//   E-LIMIT    more than kMostTrackRows rows, a line longer than 64 kB
//   W-EMPTY    rows without a position, skipped and counted
//   W-GAPS     an angle that only some rows have, taken as not recorded
RawTrack read_track_csv(const std::filesystem::path& path, const TrajectoryColumns& columns,
                        core::ProblemList& problems);

}  // namespace fanbeam::scenes
