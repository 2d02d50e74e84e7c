// Rays or slices for a scene: its facts for renderer::choose_caster.
#pragma once

#include "core/errors.h"
#include "renderer/plan/caster_choice.h"
#include "scenes/description.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/buildings/solids.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// Over the whole trajectory, so that the choice does not depend on which frames are rendered.
renderer::CasterFacts caster_facts(const sensors::Sensor& sensor, const terrain::LocalFrame& frame,
                                   const Trajectory& trajectory, const terrain::HeightField& ground,
                                   const terrain::Solids& solids);

// `asked` stands for the scene's own wish. Slices forced where they cannot show the scene become an
// error in `problems`, at the scene's line where that is what forces them.
renderer::CasterChoice scene_caster(const SceneDescription& scene,
                                    const std::optional<renderer::CasterWish>& asked,
                                    const renderer::CasterFacts& facts,
                                    core::ProblemList& problems);

}  // namespace fanbeam::scenes
