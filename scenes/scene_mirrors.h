// What reflects like a mirror in a scene, and what the effect plan wants to know of it.
//
// Neglected: frost. Soil below 0 C is taken as unfrozen at 0 C; the water in frozen soil is mostly
// ice, so it reflects less than this, by up to 4.6 dB (wet over dry loam at the normal, 35 GHz).
#pragma once

#include <optional>
#include <vector>

#include "materials/dielectric/specular_surface.h"
#include "materials/library/material_library.h"
#include "renderer/plan/scene_facts.h"
#include "scenes/description.h"
#include "scenes/scene_surfaces.h"
#include "scenes/site.h"

namespace fanbeam::scenes {

using SpecularSurfaces = std::vector<std::optional<materials::SpecularSurface>>;

// By material id, the models' own behind the library's: dielectric and rms height of what the
// library's material is in `state`. Empty without both. A medium that is not known at the sensor's frequency is as at the nearest one that it is
// known at where the scene allows extrapolation, else it does not reflect. The medium has
// surface_temperature_K, or the nearest temperature that its model knows.
SpecularSurfaces specular_surfaces(const SceneDescription& scene, const Site& site,
                                   materials::SurfaceState state);

// By material id: it mirrors in one of the two.
std::vector<bool> mirroring_materials(const SpecularSurfaces& dry, const SpecularSurfaces& shown);

// W-EXTRAPOLATED for each material of the records whose medium is not known at the sensor's
// frequency; where the scene allows that, the record lists it as well.
void report_mirrors(const SceneDescription& scene, const materials::MaterialLibrary& library,
                    std::vector<SurfaceRecord>& records, core::ProblemList& problems);

// Fills the facts on walls and mirrors.
void add_mirror_facts(const SiteFacts& site, const std::vector<bool>& mirroring,
                      renderer::SceneFacts& facts);

}  // namespace fanbeam::scenes
