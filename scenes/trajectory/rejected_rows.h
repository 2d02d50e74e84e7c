// Rows of a recorded flight that no aircraft could have flown, and what is done with them.
#pragma once

#include <cstdint>
#include <string>

namespace fanbeam::scenes {

// error   they are problems of the input
// reject  they are left out, counted in a warning and listed
// keep    nobody looks; what the file says is flown
enum class OutlierPolicy { error, reject, keep };

// Neighbours that were left out for one reason.
struct RejectedRows {
  std::int64_t first_row = 0, last_row = 0;  // counted from 1 behind the header
  std::int64_t count = 0;                    // empty rows between them are not
  int first_line = 0;                        // of the file
  double first_time_s = 0.0;                 // of the file's clock
  std::string why;                           // "time", "height", "position", "heading", "stale"
};

}  // namespace fanbeam::scenes
