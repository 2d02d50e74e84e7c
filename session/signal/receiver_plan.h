// Which of a receiver's effects a set of samples calls for (renderer/plan/signal_effects.h).
#pragma once

#include "renderer/plan/plan.h"
#include "scenes/scene.h"
#include "session/signal/receive.h"

namespace fanbeam::session {

// What the scene's plan leaves to that of the samples.
struct SignalBudget {
  core::EffectPlan sequence;  // of the scene
  double accuracy_grey = 0.5;
  renderer::EffectWishes wishes;
};
SignalBudget signal_budget(const scenes::Scene& scene);

// How what is made of the samples is shown: see renderer::SignalFacts.
struct SamplesShown {
  double window_dB = 60.0;
  bool samples_asked = false;
  int beams = 1;
};

// `beat` as synthesised, complex, the channels' gains included, `echo_W` the sum of its echoes' powers in
// the channel that has most; `interference`: what other radars add to it, or empty.
core::EffectPlan receiver_plan(const SignalBudget& budget, const SamplesShown& shown,
                               const FmcwReceiver& receiver, double echo_W,
                               const signal::FloatCube& beat,
                               const signal::FloatCube& interference = {});

// Of two plans of the same effects, for every effect the decision of the larger bound: of several
// stages or looks, each of which has samples of its own.
void keep_larger(const core::EffectPlan& other, core::EffectPlan& plan);

}  // namespace fanbeam::session
