// What a frame is made with, as the plan decided. Stages ask for their effect: what is off has no
// stage, no buffer and no random number. What is built into the world stands here too, and no stage
// asks for it.
#pragma once

#include <compare>
#include <cstdint>

#include "core/effect_plan.h"

namespace fanbeam::renderer {

struct Effects {
  core::EffectSet on;
  std::uint64_t seed = 0;  // of everything random in a frame

  bool runs(core::EffectId effect) const { return on.contains(effect); }
  // So that whoever keeps renderers by their effects cannot forget one.
  auto operator<=>(const Effects&) const = default;
};

// All that the plan runs.
Effects effects_of(const core::EffectPlan& plan, std::uint64_t seed);

// The expected picture: a realisation cannot be held against a converged one.
Effects without_draws(Effects effects);

}  // namespace fanbeam::renderer
