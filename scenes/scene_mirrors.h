// What reflects like a mirror in a scene, and what the effect plan wants to know of it.
#pragma once

#include <optional>
#include <vector>

#include "materials/dielectric/specular_surface.h"
#include "materials/library/material_library.h"
#include "renderer/plan/scene_facts.h"
#include "scenes/description.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

using SpecularSurfaces = std::vector<std::optional<materials::SpecularSurface>>;

// By index of the dry material: dielectric and rms height of what it is in `state`. Empty without
// both, and for a medium that is not known at the sensor's frequency. The medium has the weather's
// temperature, 15 C where it says none, or the nearest one that its model knows.
SpecularSurfaces specular_surfaces(const SceneDescription& scene,
                                   const materials::MaterialLibrary& library,
                                   materials::SurfaceState state);

// Fills the facts on walls, mirrors and point targets; a mirror in either list counts.
void add_mirror_facts(const std::vector<SpecularSurfaces>& specular,
                      const terrain::HeightField& field,
                      const std::vector<terrain::SurfacePatch>& patches,
                      const std::vector<terrain::PlacedMesh>& meshes, bool has_point_targets,
                      renderer::SceneFacts& facts);

}  // namespace fanbeam::scenes
