// Whether effects that run show: what leaving one out changes, beside the bound that made it run.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/report_effort.h"
#include "benchmarks/verdict.h"

namespace fanbeam::benchmarks {

// An effect that the plan of a scene runs.
struct BoundCase {
  std::string scene, effect;
  double bound_grey = 0.0, bound_dB = 0.0;
  // The largest change of any pixel of both pictures in the frames that were looked at.
  double influence_grey = 0.0;
  // Of the accuracy: what an effect could be left out for, were it the only one.
  double share_grey = 0.0;
  double dB_per_grey = 0.0;  // of the scene's display

  bool shows() const { return influence_grey > share_grey; }
  // Bound over influence, or over the share where that is more, as changes of power.
  double apart_dB() const;
};

// `effort.bound_frames` frames spread over the approach of each shipped scene whose data are there,
// at default sampling.
std::vector<BoundCase> check_bounds(const Effort& effort);

std::string bounds_markdown(const std::vector<BoundCase>& cases);
TargetRow bounds_row(const std::vector<BoundCase>& cases);

}  // namespace fanbeam::benchmarks
