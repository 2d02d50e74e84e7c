// The google-benchmark cases: frames whole, and the parts of a frame by themselves.
#pragma once

#include <vector>

#include "benchmarks/bench_scene.h"

namespace fanbeam::benchmarks {

// `scenes` must outlive the run; the parts are measured in the first of them.
void register_cases(const std::vector<BenchScene>& scenes);

}  // namespace fanbeam::benchmarks
