// What the effect plan wants to know of a scene, over its whole trajectory.
#pragma once

#include <set>
#include <vector>

#include "materials/library/material_library.h"
#include "renderer/plan/scene_facts.h"
#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/model_materials.h"
#include "scenes/scene_mirrors.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

// The parts of a scene while it is being built.
struct SceneParts {
  const SceneDescription& description;
  const terrain::LocalFrame& frame;
  const Trajectory& trajectory;
  const terrain::HeightField& ground;
  const std::vector<terrain::SurfacePatch>& patches;
  const std::vector<terrain::PlacedMesh>& meshes;
  const std::vector<renderer::PointTarget>& targets;
  const materials::MaterialLibrary& library;
  const std::set<std::size_t>& used_materials;
  const ModelMaterials& model_materials;
  const std::vector<SpecularSurfaces>& mirrors;  // dry, and in the weather's state
};

// `weather` with its rain cells placed; `largest_eta_m2_per_m3` of what falls in it.
renderer::SceneFacts facts_of(const SceneParts& parts, const atmosphere::Weather& weather,
                              double largest_eta_m2_per_m3);

// By material id: it reflects like a mirror in one of the two states.
std::vector<bool> mirroring_materials(const std::vector<SpecularSurfaces>& mirrors);

}  // namespace fanbeam::scenes
