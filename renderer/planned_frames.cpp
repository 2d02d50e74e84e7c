#include "renderer/planned_frames.h"

#include <initializer_list>

namespace fanbeam::renderer {
namespace {

unsigned stages_of(const Effects& effects) {
  unsigned stages = 0;
  for (const bool runs :
       {effects.thermal_noise, effects.speckle, effects.swerling, effects.rain_echo,
        effects.double_bounce, effects.multipath, effects.range_response})
    stages = 2 * stages + (runs ? 1U : 0U);
  return stages;
}

}  // namespace

const FrameRenderer& PlannedFrames::for_plan(const core::EffectPlan& plan) {
  const Effects effects = effects_of(plan, seed_);
  std::unique_ptr<FrameRenderer>& renderer = renderers_[stages_of(effects)];
  if (!renderer) renderer = std::make_unique<FrameRenderer>(world_, sampling_, products_, effects);
  return *renderer;
}

}  // namespace fanbeam::renderer
