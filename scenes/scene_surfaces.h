// The materials that a scene uses, in the state its weather left them in: what is checked of them,
// what run.json tells, and how much the state changes.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"
#include "materials/library/material_library.h"
#include "renderer/plan/scene_facts.h"
#include "scenes/description.h"
#include "scenes/site.h"

namespace fanbeam::scenes {

// One material in use.
struct SurfaceRecord {
  std::string material;             // as the scene names it
  std::string shown_as;             // what the state turned it into; itself when dry
  std::string model;                // "phong"
  std::string confidence;           // "assumed"
  materials::Interval grazing_rad;  // what the model's source covers
  std::vector<materials::Extrapolation> extrapolations;
};

// [materials] and weather.surface of a scene file.
void read_surfaces(core::ConfigTable& root, SceneDescription& scene);

// E-RANGE for each material of `used`, and what it turns into, that is not known at the sensor's
// frequency and polarisation; W-EXTRAPOLATED where the scene allows that.
void check_surfaces(const SceneDescription& scene, const materials::MaterialLibrary& library,
                    const std::set<std::size_t>& used, core::ProblemList& problems);

// Of the ground and what stands on it: that of the air at the scene's origin.
double surface_temperature_K(const SceneDescription& scene);

// In the order of the library. `state` is what is shown, which may be dry in a wet scene.
std::vector<SurfaceRecord> record_surfaces(const SceneDescription& scene,
                                           const materials::MaterialLibrary& library,
                                           const std::set<std::size_t>& used,
                                           materials::SurfaceState state);

// Fills the facts on surfaces: their state, what it changes, and the brightest of them. The change
// is the largest of NRCS, either way, from dry to `state`: over the materials that are used and all
// grazing angles, as the ray caster reads them (nrcs_table.h: 4096 even steps of the sine, finer
// ones below 1.8 deg, held below 0.001 deg); 3000 dB where one of the two is dark. Mirrors change with
// the medium, the rms height, and the NRCS of what mirrors.
void add_surface_facts(const Site& site, materials::SurfaceState state,
                       renderer::SceneFacts& facts);

}  // namespace fanbeam::scenes
