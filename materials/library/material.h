// A surface material: its reflectivity model, what it mirrors, what it turns into when it is wet
// or under snow, and where the figures come from.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/errors.h"
#include "materials/interval.h"
#include "materials/library/phong_reference.h"
#include "materials/library/surface_state.h"
#include "materials/nrcs/nrcs_curve.h"
#include "materials/nrcs/surface_model.h"

namespace fanbeam::materials {

// The weakest link between a measurement and the coefficients.
enum class Confidence {
  seen,      // coefficients follow directly from a source that was read
  fitted,    // our fit to a published model that was read, without inputs of our own
  recalled,  // our fit to a model whose coefficients were not checked against the source
  assumed,   // rests on an input that we assumed, such as a surface height
};

const char* name_of(Confidence confidence);

struct Material {
  std::string name;
  SurfaceModel model;
  std::optional<PhongReference> reference;  // what a Phong-like row was fitted to
  Confidence confidence = Confidence::assumed;
  std::string source;
  std::string note;
  // For mirror reflection (specular_surface.h): a name of dielectric_medium.h and the height of the
  // texture. Without both the surface mirrors nothing.
  std::string dielectric;
  std::optional<double> rms_height_m;
  // Names of the materials that this one turns into, by SurfaceState; empty for itself. Dry is
  // always itself.
  std::array<std::string, kSurfaceStateNames.size()> turns_into;
  core::Place place;  // where the library file defines it
};

}  // namespace fanbeam::materials
