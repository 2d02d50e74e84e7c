// A reflectivity model at one frequency and polarisation: what the renderer needs of a material.
#pragma once

#include "core/number_range.h"
#include "materials/nrcs/surface_model.h"

namespace fanbeam::materials {

inline constexpr core::NumberRange kNrcsFrequencies_Hz{0.1e9, 300e9};

class NrcsCurve {
 public:
  // A surface that returns nothing.
  NrcsCurve() = default;

  // The form as it stands, at every frequency. Implicit: nothing else is needed.
  NrcsCurve(const PhongNrcs& nrcs);

  // Outside the model's frequencies and polarisations the rules of surface_model.h hold; whoever
  // builds the curve asks extrapolations_of first. Throws InputError E-RANGE or E-NONFINITE for a
  // frequency outside kNrcsFrequencies_Hz.
  NrcsCurve(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz);

  // sin_grazing in [0, 1]; 0 for back faces, never negative.
  double sigma0(double sin_grazing) const;

 private:
  SurfaceModel model_ = PhongSurface{};
  Polarisation polarisation_ = Polarisation::horizontal;
  double frequency_Hz_ = PhongSurface{}.reference_frequency_Hz;
};

}  // namespace fanbeam::materials
