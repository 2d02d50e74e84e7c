// Which optional stages a frame goes through, as the plan decided: what is off has no stage, no
// buffer and no random number.
#pragma once

#include <cstdint>

#include "core/effect_plan.h"

namespace fanbeam::renderer {

struct Effects {
  bool thermal_noise = false;
  std::uint64_t seed = 0;  // of everything random in a frame
};

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed);

}  // namespace fanbeam::renderer
