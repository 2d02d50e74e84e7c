// Private to the check of recorded flights: rows that repeat a position while the flight goes on.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// The position of row `first` stands until row `last`.
struct Hold {
  std::size_t first = 0, last = 0;
  double duration_s = 0.0;
  double speed_mps = 0.0;  // of the flight meanwhile
  double last_step_s = 0.0;

  double missed_m() const { return speed_mps * duration_s; }
};

std::vector<Hold> find_holds(const RawTrack& track);

}  // namespace fanbeam::scenes
