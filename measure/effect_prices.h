// What each effect costs and what it changes, in this scene.
//
// An effect of the plan is left out, one that the plan does without is forced on, each alone; the
// others stay as planned. Both pictures are rendered by the same sampling and with the same random
// numbers, so that what differs is the effect. (Side lobes widen the fan, and rays then fall
// elsewhere: with rays their change includes that of the sampling.) Differences are of displayed,
// unrounded grey, noise included where the plan has it.
#pragma once

#include <vector>

#include "measure/bench.h"

namespace fanbeam::measure {

// Of two pictures of one size in grey.
Change change_of(const std::vector<double>& a, const std::vector<double>& b);

// A row per effect and frame; one row, of the first frame, for an effect that cannot occur.
std::vector<EffectPrice> measure_effects(const CostBench& bench);

// All frames as one: the largest of the largest changes, RMS over the frames, times as their mean.
std::vector<EffectPrice> over_frames(const std::vector<EffectPrice>& prices);

// How many frames' worth of work a run of measure_effects is.
double effects_s(const CostBench& bench);

}  // namespace fanbeam::measure
