// Choices of the arithmetic and of the sampling, each beside its alternative.
#pragma once

#include <vector>

#include "measure/bench.h"

namespace fanbeam::measure {

// In every frame of the bench, which `references` are of:
//   robust flag   of the ray-casting library, on (as shipped) and off: a scene built without it
//   beam          sub-columns of azimuth per column, 1, 2, 4 and 8, at an equal number of rays or
//                 slices
//   range         range_check.h
NumericFigures measure_numerics(const CostBench& bench,
                                const std::vector<renderer::GreyReference>& references);

double numerics_s(const CostBench& bench);

}  // namespace fanbeam::measure
