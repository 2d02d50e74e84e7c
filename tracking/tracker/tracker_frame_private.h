// One frame of a tracker: its measurements, and which of them are taken.
#pragma once

#include "tracking/tracker/tracker.h"

namespace fanbeam::tracking {

struct Tracker::Frame {
  double time_s = 0.0;
  std::vector<RadarMeasurement> measurements;
  std::vector<bool> used;
};

}  // namespace fanbeam::tracking
