// Error over time of ladders of samplings, as `fanbeam cost` and the benchmarks draw it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measure/ladder.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::measure {

struct LadderCurve {
  std::string title;       // in the key; empty for none
  std::size_t colour = 0;  // of eight
  bool dashed = false;
  std::vector<LadderStep> steps;  // a frame's, in the order of their fineness
  PickError error = bscope_with_noise;
  bool labelled = false;  // with the fineness of its ends and of its default
};

// The steps of one way.
std::vector<LadderStep> steps_of(const std::vector<LadderStep>& ladder, Way way);

// Both axes logarithmic, with marks at 90 Hz and 16 Hz; a curve without steps is left out, an error
// of zero leaves a gap.
session::Plot ladder_plot(std::string title, const std::vector<LadderCurve>& curves);

}  // namespace fanbeam::measure
