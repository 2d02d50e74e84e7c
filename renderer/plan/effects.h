// Which optional stages a frame goes through, as the plan decided: what is off has no stage, no
// buffer and no random number.
#pragma once

#include <compare>
#include <cstdint>

#include "core/effect_plan.h"

namespace fanbeam::renderer {

struct Effects {
  bool thermal_noise = false;
  bool speckle = false;   // one realisation instead of expected power, noise included
  bool swerling = false;  // targets fluctuate
  bool rain_echo = false;
  bool double_bounce = false;
  bool multipath = false;  // of point targets over reflecting ground
  bool range_response = false;
  std::uint64_t seed = 0;  // of everything random in a frame

  // So that whoever keeps renderers by their effects cannot forget one.
  auto operator<=>(const Effects&) const = default;
};

// The stage of an effect; nullptr for one that is built into the world or into samples.
bool* switch_of(core::EffectId effect, Effects& effects);

Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed);

}  // namespace fanbeam::renderer
