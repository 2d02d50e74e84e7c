#include "renderer/plan/effects.h"

#include "renderer/plan/effect_catalogue.h"

namespace fanbeam::renderer {

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed) {
  Effects effects;
  effects.thermal_noise = plan.runs(kThermalNoise);
  effects.speckle = plan.runs(kSpeckle);
  effects.swerling = plan.runs(kSwerling);
  effects.rain_echo = plan.runs(kRainEcho);
  effects.double_bounce = plan.runs(kDoubleBounce);
  effects.multipath = plan.runs(kMultipath);
  effects.range_response = plan.runs(kRangeResponse);
  effects.seed = seed;
  return effects;
}

}  // namespace fanbeam::renderer
