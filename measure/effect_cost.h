// What an effect costs in the frames of a scene: time with it less time without it.
//
// The scene is rendered twice side by side, once as planned and once with one effect the other way,
// every other effect held. After two frames of warm-up the two take turns in the same run, the
// first one changing from repetition to repetition, so that what else the machine does falls on
// both. Per frame the median of the differences, over the frames their mean.
// The error told is one standard deviation of that (core/turns.h).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "renderer/casting/sampling.h"
#include "scenes/scene.h"

namespace fanbeam::measure {

struct EffectCost {
  double ms = 0.0;  // more than 0: the effect takes time
  double error_ms = 0.0;
};

// Every effect as decided, but this one.
renderer::EffectWishes all_but(const core::EffectPlan& plan, core::EffectId flipped);

struct CostRun {
  std::vector<int> frames;
  int repetitions = 0;
  renderer::Sampling sampling;
};

// By decision of the scene's plan; nothing for effects that are not possible in it. `after_each`
// hears how many effects are done.
std::vector<std::optional<EffectCost>> effect_costs(const scenes::Scene& scene, const CostRun& run,
                                                    const std::function<void(int)>& after_each);

// Median time of a frame as planned.
double frame_ms(const scenes::Scene& scene, const CostRun& run);

}  // namespace fanbeam::measure
