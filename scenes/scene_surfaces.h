// The materials that a scene uses, in the state its weather left them in: what is checked of them,
// what run.json tells, and how much the state changes.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"
#include "materials/library/material_library.h"
#include "scenes/description.h"

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

// In the order of the library. `state` is what is shown, which may be dry in a wet scene.
std::vector<SurfaceRecord> record_surfaces(const SceneDescription& scene,
                                           const materials::MaterialLibrary& library,
                                           const std::set<std::size_t>& used,
                                           materials::SurfaceState state);

// Largest change of NRCS, either way, from dry to the scene's state: over the materials of `used`
// and 400 grazing angles from 0.5 to 90 deg, evenly spaced in their logarithm. Surfaces seen at
// flatter angles change as at 0.5 deg: every model ends there in its law for sin(psi).
double state_change_dB(const SceneDescription& scene, const materials::MaterialLibrary& library,
                       const std::set<std::size_t>& used);

}  // namespace fanbeam::scenes
