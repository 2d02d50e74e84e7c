// The measured figures as plots.
#pragma once

#include "measure/figures.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::measure {

// Error over time of each way of sampling, both logarithmic, all frames as one: solid with the
// receiver's noise, dashed without.
session::Plot cost_ladder_plot(const CostFigures& figures, bool cscope);

// Change over cost of each effect: a point at its largest change, with a line down to its RMS
// change. A change below 0.001 dB is drawn there.
session::Plot effects_plot(const CostFigures& figures);

}  // namespace fanbeam::measure
