#include "renderer/plan/effects.h"

#include "core/effect_plan.h"

namespace fanbeam::renderer {

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed) {
  Effects effects;
  effects.thermal_noise = plan.runs(core::EffectId::thermal_noise);
  effects.speckle = plan.runs(core::EffectId::speckle);
  effects.swerling = plan.runs(core::EffectId::swerling);
  effects.rain_echo = plan.runs(core::EffectId::rain_echo);
  effects.double_bounce = plan.runs(core::EffectId::double_bounce);
  effects.multipath = plan.runs(core::EffectId::multipath);
  effects.range_response = plan.runs(core::EffectId::range_response);
  effects.seed = seed;
  return effects;
}

}  // namespace fanbeam::renderer
