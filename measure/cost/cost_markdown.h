// The measured figures as a page: plots, what they say in plain words, tables, machine, method.
#pragma once

#include <string>

#include "measure/figures.h"

namespace fanbeam::measure {

// Plots are linked as ladder.svg, ladder-cscope.svg and effects.svg beside the page.
std::string cost_markdown(const CostFigures& figures);

// Its sections on the effects and on arithmetic (cost_effects_markdown.cpp).
std::string effects_section(const CostFigures& figures);
std::string numerics_section(const CostFigures& figures);

}  // namespace fanbeam::measure
