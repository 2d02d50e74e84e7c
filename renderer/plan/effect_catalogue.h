// The effects that exist, each with what must be in the scene for it, an upper bound of its
// influence, and its source.
//
// Bounds are the largest change of displayed grey that leaving the effect out can cause anywhere:
//   a multiplicative effect of x dB changes x / (dB per grey level);
//   an additive power p over a local floor f changes 10 log10(1 + p / f) dB (display_floor.h).
// They hold for the B-scope and, where heights are shown, for the C-scope of the sensor's mode. Where
// a small change can decide over a large one plan.cpp takes the whole window instead.
// What touches pictures is planned once for a sequence, from the scene. What touches samples alone
// is planned for each set of them, from their power (signal_effects.h).
// New effects are new rows, of a new core::EffectId: only the list of their names has them too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/effect_plan.h"
#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

// What an effect touches.
enum class Touches {
  pictures,  // of powers; and through the scene's echoes the samples too, where they have the effect
  samples,   // of a receiver, and all that is made of them
};

struct Effect {
  core::EffectId id;
  std::string_view what;    // "two-way loss in fog"
  std::string_view source;  // "ITU-R P.840-8": of the law that is taken by default
  bool (*possible)(const SceneFacts&);
  double (*bound_dB)(const SceneFacts&);
  std::string (*cause)(const SceneFacts&, double bound_dB);  // effect_texts.h
  std::string_view why_impossible;
  // Why a single frame goes without; empty for what is built into the world or the same in every
  // frame, and so decided for the whole sequence.
  std::string_view why_unseen = {};
  // The scene's echoes have it, and so the samples that are made of them.
  bool in_echoes = false;

  std::string_view name() const { return core::name_of(id); }
};

const std::vector<Effect>& effect_catalogue(Touches touched = Touches::pictures);
// Those that show: in pictures, or in samples with what the scene's echoes have.
std::vector<core::EffectId> effects_shown_in(Touches touched);

// Of the laws by which a scene with this weather has the effect, else its own.
std::string source_in(const Effect& effect, const atmosphere::Weather& weather);

// How far above the aircraft the bounds look for what attenuates: what level at the aircraft, tilted
// against the origin's, rises within range, 300 m at least.
double height_margin_m(const SceneFacts& facts);

}  // namespace fanbeam::renderer
