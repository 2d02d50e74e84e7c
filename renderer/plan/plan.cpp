#include "renderer/plan/plan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "renderer/plan/effect_texts.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

std::string grey_text(double bound_grey) {
  if (bound_grey >= 255.0) return "all 255 grey levels";
  return figure_text(bound_grey) + (bound_grey == 1.0 ? " grey level" : " grey levels");
}

SceneFacts with_realisation(const SceneFacts& scene, const EffectWishes& wishes) {
  SceneFacts facts = scene;
  facts.sample = scene.sample || wishes.forced_on.contains(core::EffectId::speckle) ||
                 (wishes.forced_on.contains(core::EffectId::swerling) && scene.fluctuating_targets);
  return facts;
}

bool shows_obstacles(const SceneFacts& facts) {
  return facts.heights_shown &&
         facts.sensor.display.cscope_mode == sensors::Display::CScopeMode::shadow;
}

// Thresholds decide about obstacles and detections; a realisation lets point targets cancel the
// ground they stand on. There any change can be one of the whole window.
bool tips_over(const SceneFacts& facts) {
  if (facts.signal) return false;
  return shows_obstacles(facts) || facts.read.obstacles || facts.read.detections ||
         facts.read.signals || (facts.sample && facts.has_point_targets);
}

// Watts hold the noise, and it crosses thresholds, where no display shows it.
bool reads_noise(const SceneFacts& facts) {
  return facts.read.watts() || facts.read.detections || facts.read.signals;
}

std::string noise_readers_text(const Readings& read) {
  if (read.detections) return "asked for by the product detections, as it crosses thresholds";
  if (read.signals) return "asked for by signals, whose detections cross thresholds with it";
  if (read.power) return "asked for by the product power, whose watts hold it";
  return "asked for by the product labels, whose signal to clutter counts it";
}

// Greys of the picture that shows the facts' products.
struct Greys {
  double window_dB = 0.0;
  double dB_per_grey = 0.0;
};

Greys greys_of(const SceneFacts& facts) {
  if (facts.signal) return {facts.signal->window_dB, facts.signal->window_dB / 255.0};
  const sensors::GreyScale scale(facts.sensor);
  return {scale.window_dB(), scale.dB_per_grey()};
}

// An effect that the budget decides on.
struct Open {
  const Effect* effect = nullptr;
  core::EffectDecision* decision = nullptr;
  double own_dB = 0.0;  // its bound, were it not for tips_over
};

// Fills in the decision's bound.
Open weighed(const Effect& effect, const SceneFacts& facts, const Greys& greys,
             core::EffectDecision& decision) {
  const double own_dB = effect.bound_dB(facts);
  decision.bound_dB = own_dB > 0.0 && tips_over(facts) ? std::max(own_dB, greys.window_dB) : own_dB;
  decision.bound_grey = std::min(decision.bound_dB / greys.dB_per_grey, 255.0);
  return {&effect, &decision, own_dB};
}

std::string cause_text(const Open& open, const SceneFacts& facts) {
  const std::string text = open.effect->cause(facts, open.own_dB);
  if (!(open.decision->bound_dB > open.own_dB)) return text;
  if (shows_obstacles(facts))
    return text + ", which in a C-scope of mode shadow can raise or hide a whole obstacle";
  if (facts.read.obstacles)
    return text + ", which can raise or hide a whole one of the product obstacles";
  if (facts.read.detections) return text + ", which can make or hide one of the product detections";
  if (facts.read.signals) return text + ", which can make or hide a detection in the signals";
  return text + ", which can tip a pixel where a target and the ground cancel";
}

// Leaves out what fits into `left_grey`, smallest first.
void share_budget(std::vector<Open> open, const SceneFacts& facts, double left_grey) {
  std::stable_sort(open.begin(), open.end(), [](const Open& a, const Open& b) {
    return a.decision->bound_grey < b.decision->bound_grey;
  });
  for (const Open& each : open) {
    core::EffectDecision& decision = *each.decision;
    decision.on = decision.bound_grey > left_grey;
    if (!decision.on && decision.effect == core::EffectId::thermal_noise && reads_noise(facts)) {
      decision.on = true;
      decision.reason = noise_readers_text(facts.read);
      continue;
    }
    decision.reason = cause_text(each, facts) + ": " + grey_text(decision.bound_grey) + ", " +
                      (decision.on ? "more than" : "within") + " the " +
                      figure_text(std::max(left_grey, 0.0)) + " that the budget leaves";
    if (!decision.on) left_grey -= decision.bound_grey;
  }
}

std::string by_user(const std::string& verdict, const core::EffectDecision& decision) {
  if (!(decision.bound_grey > 0.0)) return verdict;
  return verdict + (decision.on ? "; it can change" : ", though it can change") +
         " a pixel by up to " + grey_text(decision.bound_grey);
}

// Noise that is shown for certain is part of the floor of every other effect.
bool noise_runs(const SceneFacts& facts, double accuracy_grey, const EffectWishes& wishes,
                const Greys& greys) {
  if (wishes.forced_off.contains(core::EffectId::thermal_noise)) return false;
  if (wishes.forced_on.contains(core::EffectId::thermal_noise)) return true;
  if (wishes.base != EffectWishes::Base::as_needed) return wishes.base == EffectWishes::Base::all;
  if (reads_noise(facts)) return true;
  const auto& catalogue = effect_catalogue();
  const auto noise = std::find_if(catalogue.begin(), catalogue.end(), [](const Effect& effect) {
    return effect.id == core::EffectId::thermal_noise;
  });
  core::EffectDecision decision;
  weighed(*noise, facts, greys, decision);
  return decision.bound_grey > effects_share_grey(accuracy_grey);
}

std::string why_without(const Effect& effect, const SceneFacts& scene) {
  if (!effect.possible(scene)) return std::string(effect.why_impossible);
  return effect.why_unseen.empty() ? "the scene has it, but nothing of it is in view"
                                   : std::string(effect.why_unseen);
}

// What wishes and possibility leave open, `left_grey` decides. `facts`: what is seen of `scene`.
core::EffectPlan decided(const std::vector<Effect>& catalogue, const SceneFacts& scene,
                         const SceneFacts& facts, const Greys& greys, const EffectWishes& wishes,
                         double left_grey) {
  core::EffectPlan result;
  result.decisions.resize(catalogue.size());
  std::vector<Open> open;
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    const Effect& effect = catalogue[i];
    core::EffectDecision& decision = result.decisions[i];
    decision.effect = effect.id;
    const bool seen = effect.possible(facts);
    const bool forced =
        wishes.forced_on.contains(effect.id) || wishes.base == EffectWishes::Base::all;
    Open weighing;
    if (seen) weighing = weighed(effect, facts, greys, decision);
    if (wishes.forced_off.contains(effect.id)) {
      decision.reason = by_user("switched off by the user", decision);
    } else if (forced && (seen || effect.possible(scene))) {
      decision.on = true;
      decision.reason = seen ? by_user("switched on by the user", decision)
                             : "switched on by the user; " + why_without(effect, scene);
    } else if (!seen) {
      decision.reason = why_without(effect, scene);
    } else if (wishes.base == EffectWishes::Base::none) {
      decision.reason = by_user("switched off by the user", decision);
    } else {
      open.push_back(weighing);
    }
  }
  share_budget(std::move(open), facts, left_grey);
  return result;
}

// Of half the accuracy, after what the sequence goes without.
double left_of_budget_grey(const core::EffectPlan& sequence, double accuracy_grey,
                           const EffectWishes& wishes) {
  double left_grey = effects_share_grey(accuracy_grey);
  for (const core::EffectDecision& decision : sequence.decisions)
    if (!decision.on && !wishes.forced_off.contains(decision.effect))
      left_grey -= decision.bound_grey;
  return left_grey;
}

std::vector<core::EffectId> known_effects(Touches touched) {
  std::vector<core::EffectId> known;
  for (const Effect& effect : effect_catalogue()) known.push_back(effect.id);
  if (touched == Touches::samples)
    for (const Effect& effect : effect_catalogue(touched)) known.push_back(effect.id);
  return known;
}

std::string wishes_text(const std::vector<core::EffectId>& effects) {
  std::string text;
  for (const core::EffectId effect : effects) text.append(" +").append(name_of(effect));
  return text;
}

}  // namespace

EffectWishes parse_effect_wishes(const std::string& text, Touches touched) {
  const std::vector<core::EffectId> effects = known_effects(touched);
  const std::vector<core::EffectId> shown = effects_shown_in(touched);
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
      const auto found =
          word.empty() ? effects.end()
                       : std::ranges::find(effects, std::string_view(word).substr(1),
                                           [](core::EffectId effect) { return name_of(effect); });
      if (found == effects.end() || (word[0] != '+' && word[0] != '-'))
        core::throw_input_error(core::ErrorClass::ref, "--effects", "\"" + word + "\"",
                                "all, none, or + or - before one of" + wishes_text(effects));
      if (word[0] == '+' && std::ranges::find(shown, *found) == shown.end())
        core::throw_input_error(core::ErrorClass::unsupported, "--effects", "\"" + word + "\"",
                                "one that samples show:" + wishes_text(shown));
      (word[0] == '+' ? wishes.forced_on : wishes.forced_off).insert(*found);
    }
  }
  return wishes;
}

void refuse_draws(const EffectWishes& wishes, core::ProblemList& problems) {
  for (const core::EffectId draw : {core::EffectId::speckle, core::EffectId::swerling})
    if (wishes.forced_on.contains(draw))
      problems.error(core::ErrorClass::unsupported, {}, "--effects",
                     "\"+" + std::string(name_of(draw)) + "\"",
                     "no effect of a draw beside the realisation mean, which is the "
                     "expectation of all draws");
}

core::EffectPlan plan(const SceneFacts& scene, double accuracy_grey, const EffectWishes& wishes) {
  return plan(scene, scene, accuracy_grey, wishes);
}

core::EffectPlan plan(const SceneFacts& scene, const SceneFacts& seen, double accuracy_grey,
                      const EffectWishes& wishes) {
  SceneFacts facts = with_realisation(seen, wishes);
  const Greys greys = greys_of(facts);
  facts.noise_shown = noise_runs(facts, accuracy_grey, wishes, greys);
  return decided(effect_catalogue(), with_realisation(scene, wishes), facts, greys, wishes,
                 effects_share_grey(accuracy_grey));
}

core::EffectPlan frame_plan(const core::EffectPlan& sequence, const SceneFacts& frame,
                            double accuracy_grey, const EffectWishes& wishes) {
  core::EffectPlan result = sequence;
  if (wishes.base != EffectWishes::Base::as_needed) return result;
  SceneFacts facts = with_realisation(frame, wishes);
  facts.noise_shown = result.runs(core::EffectId::thermal_noise);
  const Greys greys = greys_of(facts);
  std::vector<Open> open;
  for (core::EffectDecision& decision : result.decisions) {
    const auto effect =
        std::find_if(effect_catalogue().begin(), effect_catalogue().end(),
                     [&](const Effect& each) { return each.id == decision.effect; });
    if (!decision.on || effect == effect_catalogue().end() || effect->why_unseen.empty() ||
        wishes.forced_on.contains(decision.effect))
      continue;
    if (!effect->possible(facts)) {
      decision = {decision.effect, false, std::string(effect->why_unseen)};
      continue;
    }
    open.push_back(weighed(*effect, facts, greys, decision));
  }
  share_budget(std::move(open), facts, left_of_budget_grey(sequence, accuracy_grey, wishes));
  return result;
}

core::EffectPlan signal_plan(const core::EffectPlan& sequence, const SceneFacts& samples,
                             double accuracy_grey, const EffectWishes& wishes) {
  if (!samples.signal) throw core::InternalError("a plan of samples without their facts");
  SceneFacts facts = samples;
  facts.noise_shown = !wishes.forced_off.contains(core::EffectId::receiver_noise) &&
                      (wishes.base != EffectWishes::Base::none ||
                       wishes.forced_on.contains(core::EffectId::receiver_noise));
  return decided(effect_catalogue(Touches::samples), facts, facts, greys_of(facts), wishes,
                 left_of_budget_grey(sequence, accuracy_grey, wishes));
}

}  // namespace fanbeam::renderer
