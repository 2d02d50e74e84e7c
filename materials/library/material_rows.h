// Rows of a material library as a radar of one frequency and polarisation sees them, surfaces being dry, wet or
// under snow: what `fanbeam materials` lists and draws.
#pragma once

#include <string>
#include <vector>

#include "core/polarisation.h"
#include "materials/library/material_library.h"

namespace fanbeam::materials {

struct MaterialRow {
  const Material& dry;
  const Material& shown;  // what it turns into in that state
  NrcsCurve curve;
  bool known;  // at that frequency and polarisation; else extrapolated

  // sigma0; -infinity for a dark surface.
  double level_dB(double grazing_deg) const;
};

// Of all materials in the order of the library, which must outlive them. Throws as NrcsCurve and surface_state_of do.
std::vector<MaterialRow> rows_under(const MaterialLibrary& library, double frequency_Hz,
                                    core::Polarisation polarisation, SurfaceState state);

inline constexpr double kListAngles_deg[] = {3.0, 10.0, 30.0};

// "HH", "VV" or "any": what the model tells apart.
const char* polarisation_text(const ModelValidity& known);

// An object: names, model with its coefficients and what it is known for, sigma0 in dB at kListAngles_deg (null for a
// dark one), dielectric and roughness where it has them, confidence and source.
std::string row_json(const MaterialRow& row);

}  // namespace fanbeam::materials
