// How well tracks keep their targets over time: CLEAR-MOT.
//
//   MOTA = 1 - sum (missed + false + switches) / sum (targets),   MOTP = mean distance of matches
// In every frame the matches of the frame before stay while their distance is inside the gate;
// only the rest is assigned anew, at the least sum of distances. A switch is counted when a target
// is matched to another track than the last it was matched to. A track whose id is among those excused may
// match a target, and is no false one where it does not.
// Source: K. Bernardin, R. Stiefelhagen, "Evaluating multiple object tracking performance: the
// CLEAR MOT metrics", EURASIP J. Image and Video Processing, 2008.
// Inputs: a gate above 0 (E-RANGE), finite places (E-NONFINITE), names that occur once in a frame
// (E-RANGE). Without any target MOTA is 1 less the number of false tracks; without a match MOTP is
// empty.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "tracking/metrics/ospa.h"

namespace fanbeam::tracking {

struct NamedPlace {
  int id = 0;
  Place place;
};

class ClearMot {
 public:
  explicit ClearMot(double gate_m);
  void add_frame(const std::vector<NamedPlace>& targets, const std::vector<NamedPlace>& tracks,
                 const std::set<int>& excused = {});

  int instances() const { return instances_; }
  int missed() const { return missed_; }
  int false_tracks() const { return false_; }
  int switches() const { return switches_; }
  double mota() const;
  std::optional<double> motp_m() const;
  // Track of each target matched in the last frame.
  const std::map<int, int>& current_match() const { return current_; }
  // Track that each target was ever matched to last.
  const std::map<int, int>& last_match() const { return last_; }

 private:
  double gate_m_;
  int instances_ = 0, missed_ = 0, false_ = 0, switches_ = 0, matches_ = 0;
  double distance_sum_m_ = 0.0;
  std::map<int, int> current_, last_;  // track of each target
};

}  // namespace fanbeam::tracking
