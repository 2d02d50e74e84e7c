#include "materials/dielectric/roughness.h"

#include <cmath>

#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::materials {
namespace {

// Height seen along the line of sight, in wavelengths.
double height_in_wavelengths(double rms_height_m, double wavelength_m, double grazing_rad) {
  core::require_range("rms_height_m", rms_height_m, {0.0, 1e3});
  core::require_range("wavelength_m", wavelength_m, {1e-6, 1e3});
  core::require_range("grazing_rad", grazing_rad, {0.0, core::kPi / 2.0});
  return rms_height_m * std::sin(grazing_rad) / wavelength_m;
}

}  // namespace

double coherent_power_factor(double rms_height_m, double wavelength_m, double grazing_rad) {
  const double phase_rad =
      4.0 * core::kPi * height_in_wavelengths(rms_height_m, wavelength_m, grazing_rad);
  return std::exp(-phase_rad * phase_rad);
}

}  // namespace fanbeam::materials
