// Decides which effects run: a pure function of the scene's facts, the accuracy asked for and the
// user's wishes.
#pragma once

#include <string>
#include <vector>

#include "core/effect_plan.h"
#include "renderer/plan/effect_catalogue.h"

namespace fanbeam::renderer {

// What the user forces, by effect name; `base` is what happens to effects not named.
struct EffectWishes {
  enum class Base { as_needed, all, none };
  Base base = Base::as_needed;
  std::vector<std::string> forced_on, forced_off;
};

// "all", "none", "+rain,-gas", "all,-fog". Throws InputError E-REF for an unknown effect, naming
// the known ones.
EffectWishes parse_effect_wishes(const std::string& text);

// Half of `accuracy_grey` is for effects left out: an effect that is possible and not forced runs
// unless its bound, added to the bounds of those already left out (smallest first), stays within
// that half. Speckle or fluctuating targets forced on ask for a realisation where the scene does not.
core::EffectPlan plan(const SceneFacts& scene, double accuracy_grey, const EffectWishes& wishes);

}  // namespace fanbeam::renderer
