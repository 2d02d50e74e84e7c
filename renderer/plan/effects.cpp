#include "renderer/plan/effects.h"

namespace fanbeam::renderer {

bool* switch_of(core::EffectId effect, Effects& effects) {
  if (effect == core::EffectId::thermal_noise) return &effects.thermal_noise;
  if (effect == core::EffectId::speckle) return &effects.speckle;
  if (effect == core::EffectId::swerling) return &effects.swerling;
  if (effect == core::EffectId::rain_echo) return &effects.rain_echo;
  if (effect == core::EffectId::double_bounce) return &effects.double_bounce;
  if (effect == core::EffectId::multipath) return &effects.multipath;
  if (effect == core::EffectId::range_response) return &effects.range_response;
  return nullptr;
}

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed) {
  Effects effects;
  for (const core::EffectDecision& decision : plan.decisions)
    if (bool* const runs = switch_of(decision.effect, effects)) *runs = decision.on;
  effects.seed = seed;
  return effects;
}

}  // namespace fanbeam::renderer
