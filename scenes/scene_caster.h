// Rays or slices for a scene: its facts for renderer::choose_caster.
#pragma once

#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/plan/caster_choice.h"
#include "scenes/description.h"
#include "scenes/flight_volume.h"
#include "terrain/buildings/solids.h"

namespace fanbeam::scenes {

// For the whole flight volume, so that neither depends on which frames are rendered. `asked` stands for
// the scene's own wish.

// Slices forced where they cannot show the scene, whatever its plan, become an error in `problems`, at
// the scene's line where that is what forces them.
void check_caster(const SceneDescription& scene, const std::optional<renderer::CasterWish>& asked,
                  const FlightVolume& volume, const terrain::Solids& solids,
                  core::ProblemList& problems);

// Of what check_caster() has no problem with.
renderer::CasterChoice scene_caster(const SceneDescription& scene,
                                    const std::optional<renderer::CasterWish>& asked,
                                    const FlightVolume& volume, const terrain::Solids& solids,
                                    const core::EffectPlan& plan);

}  // namespace fanbeam::scenes
