// Turns the described objects into patches, meshes and point targets on the scene's ground.
#pragma once

#include <vector>

#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/ground.h"
#include "scenes/model_materials.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

// The rectangles of [[surface]] in file order, the runways on top of them.
std::vector<terrain::SurfacePatch> build_patches(const SceneDescription& scene,
                                                 const Ground& ground, const MaterialNames& names);

std::vector<terrain::PlacedMesh> build_meshes(const SceneDescription& scene, const Ground& ground,
                                              const MaterialNames& names,
                                              ModelMaterials& model_materials,
                                              core::ProblemList& problems);

// E-LIMIT for a line of more than 100000 points; W-NEAR-FIELD, see near_field.h.
std::vector<renderer::PointTarget> build_targets(const SceneDescription& scene,
                                                 const Ground& ground, core::ProblemList& problems);

}  // namespace fanbeam::scenes
