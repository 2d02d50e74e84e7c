// One frame of a tracker: its measurements, which of them are taken, and the pairs that it cannot resolve.
#pragma once

#include "tracking/tracker/tracker.h"

namespace fanbeam::tracking {

// A confirmed track in whose gate a measurement lies.
struct Claim {
  std::size_t track = 0;  // its place among the tracks
  double log_likelihood = 0.0;
};

struct Tracker::Frame {
  double time_s = 0.0;
  std::vector<RadarMeasurement> measurements;
  std::vector<bool> used;
  std::vector<std::vector<Claim>> claims;  // of every measurement; none before a pair asks
};

// A pair that is set aside.
struct Tracker::PairPlaces {
  int id = 0;  // of either
  PolarPlace here, there;
};

}  // namespace fanbeam::tracking
