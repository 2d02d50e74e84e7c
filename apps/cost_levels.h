// The picture-level path against the signal-level path: error over time of a frame's B-scope.
//
// Each is held against the converged powers of its own effects in thin range cells with the sweep's
// exact range response (renderer/accuracy/swept_picture.h), the receiver's mean noise in them all.
//   picture   rays at several samplings, and the renderer's range response
//   signal    beat signals (session/signal/signal_bscope.h): the mean of so many looks, each with its
//             speckle and its noise
// The picture is the whole one, every effect of the plan in it. The signal level is of surfaces and
// point targets alone, and so is what it is held against: it has neither double bounce nor echo of
// rain, and multipath has a phase there, which expected powers have not. The aircraft stands: no
// Doppler.
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
