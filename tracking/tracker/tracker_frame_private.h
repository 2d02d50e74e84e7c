// One frame of a tracker: its measurements, and which of them are taken.
#pragma once

#include <array>

#include "tracking/tracker/tracker.h"

namespace fanbeam::tracking {

// The tracks that a measurement fits best, of those that are confirmed and not set aside: beside the two of a pair a third.
struct Claim {
  int id = 0;  // of no track
  double log_likelihood = -1e300;
};
using Claims = std::array<Claim, 3>;

struct Tracker::Frame {
  double time_s = 0.0;
  std::vector<RadarMeasurement> measurements;
  std::vector<bool> used;
  std::vector<Claims> claims;  // of every measurement; none before a pair asks
};

}  // namespace fanbeam::tracking
