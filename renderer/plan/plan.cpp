#include "renderer/plan/plan.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "core/errors.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

// A C-scope of mode shadow raises an obstacle or does not, by thresholds; a realisation lets point
// targets cancel the ground they stand on. There any change can be one of the whole window.
bool tips_over(const SceneFacts& facts) {
  return facts.sensor.display.cscope_mode == sensors::Display::CScopeMode::shadow ||
         (facts.sample && facts.has_point_targets);
}

double bound_dB(const Effect& effect, const SceneFacts& facts, double window_dB) {
  const double bound_dB = effect.bound_dB(facts);
  return bound_dB > 0.0 && tips_over(facts) ? std::max(bound_dB, window_dB) : bound_dB;
}

}  // namespace

EffectWishes parse_effect_wishes(const std::string& text) {
  EffectWishes wishes;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, comma - from);
    from = comma + 1;
    if (word == "all") {
      wishes.base = EffectWishes::Base::all;
    } else if (word == "none") {
      wishes.base = EffectWishes::Base::none;
    } else {
      std::string known;
      bool found = false;
      for (const Effect& effect : effect_catalogue()) {
        known += " +" + std::string(effect.name);
        found = found || (word.size() > 1 && word.substr(1) == effect.name);
      }
      if (!found || (word[0] != '+' && word[0] != '-'))
        core::throw_input_error(core::ErrorClass::ref, "--effects", "\"" + word + "\"",
                                "all, none, or + or - before one of" + known);
      (word[0] == '+' ? wishes.forced_on : wishes.forced_off).push_back(word.substr(1));
    }
  }
  return wishes;
}

core::EffectPlan plan(const SceneFacts& scene, double accuracy_grey, const EffectWishes& wishes) {
  const std::vector<Effect>& catalogue = effect_catalogue();
  SceneFacts facts = scene;
  facts.sample =
      scene.sample || contains(wishes.forced_on, kSpeckle) || contains(wishes.forced_on, kSwerling);
  const sensors::GreyScale scale(facts.sensor);
  core::EffectPlan result;
  std::vector<bool> open(catalogue.size(), false);
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    const Effect& effect = catalogue[i];
    core::EffectDecision decision;
    decision.effect = effect.name;
    const bool possible = effect.possible(facts);
    if (possible) {
      decision.bound_dB = bound_dB(effect, facts, scale.window_dB());
      decision.bound_grey = decision.bound_dB / scale.dB_per_grey();
    }
    if (contains(wishes.forced_off, effect.name)) {
      decision.reason = "switched off by the user";
    } else if (!possible) {
      decision.reason = effect.why_impossible;
    } else if (contains(wishes.forced_on, effect.name) || wishes.base == EffectWishes::Base::all) {
      decision.on = true;
      decision.reason = "switched on by the user";
    } else if (wishes.base == EffectWishes::Base::none) {
      decision.reason = "switched off by the user";
    } else {
      open[i] = true;
    }
    result.decisions.push_back(decision);
  }
  std::vector<std::size_t> order(catalogue.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.decisions[a].bound_grey < result.decisions[b].bound_grey;
  });
  double left_grey = accuracy_grey / 2.0;
  for (const std::size_t i : order) {
    if (!open[i]) continue;
    core::EffectDecision& decision = result.decisions[i];
    decision.on = decision.bound_grey > left_grey;
    if (!decision.on) left_grey -= decision.bound_grey;
    decision.reason = std::string(catalogue[i].what) + " can change a pixel by up to " +
                      rounded(decision.bound_grey) + " grey levels, " +
                      (decision.on ? "more" : "less") + " than the budget leaves";
  }
  return result;
}

}  // namespace fanbeam::renderer
