// Tracks of measurements without a truth: ranges over time, and seen from above.
#pragma once

#include <map>
#include <string>

#include "session/plots/gnuplot.h"
#include "session/signal/sources/measured_source.h"
#include "tracking/tracker/tracker.h"

namespace fanbeam::session {

class OwnHistory {
 public:
  void add(const MeasuredFrame& frame, const tracking::Tracker& tracker);

  // Measurements as dots; tracks of what moves as lines in colours, of what stands in black.
  Plot ranges(const std::string& name) const;
  // Where tracks were, relative to the radar.
  Plot plan(const std::string& name) const;

 private:
  struct Line {
    std::vector<double> time_s, range_m, forward_m, right_m;
    int moving = 0;  // in how many of them
    bool moves() const { return 2 * moving > static_cast<int>(time_s.size()); }
  };
  std::map<int, Line> tracks_;  // confirmed
  Line measurements_;
};

}  // namespace fanbeam::session
