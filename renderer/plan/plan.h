// Decides which effects run: a pure function of the scene's facts, the accuracy asked for and the
// user's wishes.
#pragma once

#include <string>

#include "core/effect_plan.h"
#include "core/number_range.h"
#include "renderer/plan/effect_catalogue.h"

namespace fanbeam::renderer {

// What the user forces; `base` is what happens to other effects.
struct EffectWishes {
  enum class Base { as_needed, all, none };
  Base base = Base::as_needed;
  core::EffectSet forced_on, forced_off;
};

// "all", "none", "+rain,-gas", "all,-fog". Throws InputError: E-REF for an unknown effect, naming
// the known ones, those that touch pictures and for `touched` samples these as well; E-UNSUPPORTED
// for one forced on that samples do not show (effects_shown_in).
EffectWishes parse_effect_wishes(const std::string& text, Touches touched = Touches::pictures);

// Adds E-UNSUPPORTED where they force speckle or fluctuating targets on: for whoever asks for the
// expected power, realisation mean.
void refuse_draws(const EffectWishes& wishes, core::ProblemList& problems);

// That may be asked for, in grey levels.
inline constexpr core::NumberRange kAccuracies_grey{0.01, 100.0};
// Allowed times for a frame.
inline constexpr core::NumberRange kTimeBudgets_ms{0.1, 1e7};

// Of the grey levels asked for, what is for effects left out and what for sampling.
constexpr double effects_share_grey(double accuracy_grey) { return accuracy_grey / 2.0; }
constexpr double sampling_share_grey(double accuracy_grey) {
  return accuracy_grey - effects_share_grey(accuracy_grey);
}

// Half of `accuracy_grey` is for effects left out: an effect that is possible and not forced runs
// unless its bound, added to the bounds of those already left out (smallest first), stays within
// that half. Speckle forced on asks for a realisation where the scene does not, and so do fluctuating
// targets where there is one.
core::EffectPlan plan(const SceneFacts& scene, double accuracy_grey, const EffectWishes& wishes);
// Of a scene of which the frames together see only `seen` (seen_facts() of it): decided by that. What
// the user forces on runs wherever the scene has it, seen or not.
core::EffectPlan plan(const SceneFacts& scene, const SceneFacts& seen, double accuracy_grey,
                      const EffectWishes& wishes);

// The plan of one frame, inside the plan of its sequence (of the same wishes): `frame` from
// frame_facts.h. A world is built for the sequence, so that everything keeps its state but stages
// that a frame can go without (Effect::why_unseen), rain echo, double bounce and multipath. Of these
// the ones that the sequence runs and nobody forced on are left out where the frame's bound stays
// within what is left of that half: what the sequence leaves out takes its bound there first. So
// all that a frame goes without, and with that any switch from frame to frame, changes a pixel by
// at most half of `accuracy_grey`.
core::EffectPlan frame_plan(const core::EffectPlan& sequence, const SceneFacts& frame,
                            double accuracy_grey, const EffectWishes& wishes);

// The plan of one set of samples, beside the plan of its sequence (of the same wishes): effects that
// touch samples alone, by the facts that `samples` holds of them. What the sequence leaves out takes
// its bound from that half first. Of the scene's facts the sensor and `sample` are used.
core::EffectPlan signal_plan(const core::EffectPlan& sequence, const SceneFacts& samples,
                             double accuracy_grey, const EffectWishes& wishes);

}  // namespace fanbeam::renderer
