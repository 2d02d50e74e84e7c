#include "session/opening_words.h"

#include <algorithm>

#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"

namespace fanbeam::session {

void take_words(const std::string& effects, const std::string& caster, const std::string& prefix,
                Setup& setup, core::ProblemList& problems) {
  core::ProblemList of_effects;
  try {
    if (!effects.empty()) setup.build.wishes = renderer::parse_effect_wishes(effects);
    if (setup.sample && !*setup.sample) renderer::refuse_draws(setup.build.wishes, of_effects);
  } catch (const core::InputError& error) {
    of_effects.append(error.problems());
  }
  for (core::Problem problem : of_effects.all()) {
    problem.field = prefix + "effects";
    problems.append({problem});
  }
  if (caster.empty()) return;
  const auto& words = renderer::kCasterWishes;
  if (std::find(words.begin(), words.end(), caster) == words.end())
    problems.error(core::ErrorClass::ref, {}, prefix + "caster", "\"" + caster + "\"",
                   "rays, profile or auto");
  else
    setup.build.caster = renderer::caster_wish(caster);
}

}  // namespace fanbeam::session
