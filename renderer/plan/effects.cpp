#include "renderer/plan/effects.h"

#include "renderer/plan/effect_catalogue.h"

namespace fanbeam::renderer {

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed) {
  Effects effects;
  effects.thermal_noise = plan.runs(kThermalNoise);
  effects.seed = seed;
  return effects;
}

}  // namespace fanbeam::renderer
