// What a Phong-like row of the library was fitted to, as data, so that the fit can be made again
// from the file alone.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "materials/nrcs/phong_fit.h"
#include "materials/nrcs/surface_model.h"

namespace fanbeam::materials {

// Grazing angles of a fit, named as files name them.
enum class FitAngles {
  standard,   // phong_fit.h's, 1 to 60 deg
  steep,      // 20 to 80 deg in steps of 5: where Oh's model was fitted
  to_normal,  // the standard ones and on to 90 deg in steps of 5: for walls of metal
};
inline constexpr std::array<std::string_view, 3> kFitAnglesNames = {"standard", "steep",
                                                                    "to-normal"};
const std::vector<double>& fit_angles_deg(FitAngles angles);

struct PhongReference {
  SurfaceModel model;
  FitAngles angles = FitAngles::standard;
  double offset_dB = 0.0;  // added to the model: a documented change of state
  // The frequency exponent is the mean slope in dB from the reference frequency to this one; 0
  // where the exponent is given, not derived.
  double exponent_to_Hz = 0.0;
};

struct PhongDerivation {
  PhongFit fit;
  double frequency_exponent = 0.0;  // the given one where none is derived
};

// Fits again what `row` was fitted to, at its reference frequency and for its polarisation (HH
// where it tells none apart). Throws InputError as sigma0 of surface_model.h does.
PhongDerivation derive(const PhongSurface& row, const PhongReference& reference);

// Numbers as the library prints them: a, b and c with five digits, the exponent with four.
std::string five_digits(double value);
std::string four_digits(double value);

}  // namespace fanbeam::materials
