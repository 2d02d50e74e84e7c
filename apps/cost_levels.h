// The picture-level path against the signal-level path: error over time of the same B-scope.
//
// Both are held against the converged powers in thin range cells with the sweep's exact range
// response (renderer/accuracy/swept_picture.h), the receiver's mean noise in all of them.
//   picture   rays at several samplings, and the renderer's range response
//   signal    beat signals (session/signal/signal_bscope.h): the mean of so many looks, each with its
//             speckle and its noise
// Surfaces and point targets only: what the signal level lacks (double bounce, echo of rain,
// multipath) is off in both. The aircraft stands: no Doppler.
#pragma once

#include <vector>

#include "measure/bench.h"

namespace fanbeam::apps {

// Why the scene's sensor has no signal level; empty where it has.
std::string why_no_levels(const measure::CostBench& bench);

// Of the bench's first frame. The sensor must have a signal level.
std::vector<measure::LevelStep> measure_levels(const measure::CostBench& bench);

double levels_s(const measure::CostBench& bench);

}  // namespace fanbeam::apps
