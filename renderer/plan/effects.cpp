#include "renderer/plan/effects.h"

namespace fanbeam::renderer {

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed) {
  Effects effects{{}, seed};
  for (const core::EffectDecision& decision : plan.decisions)
    if (decision.on) effects.on.insert(decision.effect);
  return effects;
}

Effects without_draws(Effects effects) {
  effects.on.erase(core::EffectId::speckle);
  effects.on.erase(core::EffectId::swerling);
  return effects;
}

}  // namespace fanbeam::renderer
