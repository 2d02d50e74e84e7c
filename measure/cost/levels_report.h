// What was measured of the signal level as CSV, plot and a section of the page.
#pragma once

#include <string>

#include "measure/figures.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::measure {

std::string levels_csv(const CostFigures& figures);
session::Plot levels_plot(const CostFigures& figures);
// The plot is linked as levels.svg. Says why where there is no signal level; empty where it was not
// asked for.
std::string levels_section(const CostFigures& figures);

}  // namespace fanbeam::measure
