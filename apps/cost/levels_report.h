// What levels.h measured as CSV, plot and a section of the page.
#pragma once

#include <string>

#include "apps/cost/figures.h"
#include "apps/gnuplot.h"

namespace fanbeam::apps {

std::string levels_csv(const CostFigures& figures);
Plot levels_plot(const CostFigures& figures);
// The plot is linked as levels.svg. Says why where there is no signal level; empty where it was not
// asked for.
std::string levels_section(const CostFigures& figures);

}  // namespace fanbeam::apps
