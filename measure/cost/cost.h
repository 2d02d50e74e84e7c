// What accuracy and effects cost in time on a scene: what `fanbeam cost` measures, and its files. The signal
// level (CostFigures::levels) is its caller's.
#pragma once

#include <filesystem>

#include "measure/bench.h"
#include "measure/figures.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::measure {

struct CostParts {
  bool ladder = true, effects = true, numerics = true;
};

// How long one frame takes, in each way of sampling, which all later durations are foreseen by.
Pace measure_pace(const scenes::Scene& scene, int frame, bool slices);

// How long measure_cost is expected to take.
double expected_cost_s(const CostBench& bench, const CostParts& parts);
// `threads`: as they are, for the record.
CostFigures measure_cost(const CostBench& bench, const CostParts& parts, int threads);

// ladder.csv, equal_error.csv, effects.csv, numerics.csv and levels.csv of what was measured, plots as
// SVG and PNG, and cost.md. Plots last: whoever lacks gnuplot has the figures.
void write_cost(const CostFigures& figures, const std::filesystem::path& folder);

}  // namespace fanbeam::measure
