// Rows of the table of targets for what was measured of views: errors and times of frames.
#pragma once

#include "benchmarks/bench_report.h"

namespace fanbeam::benchmarks {

// Of a scene with ladders.
TargetRows view_rows(const SceneFigures& scene, int threads);

// Of the city and of the shower by default, where 16 frames/s on disk are asked for: errors as at
// 16 Hz.
TargetRows default_rows(const std::string& scene, const std::vector<DefaultError>& views);

}  // namespace fanbeam::benchmarks
