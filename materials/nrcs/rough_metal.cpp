#include "materials/nrcs/rough_metal.h"

#include <cmath>

#include "core/constants.h"
#include "core/number_range.h"
#include "materials/dielectric/roughness.h"

namespace fanbeam::materials {

double rough_metal_sigma0(const RoughMetal& surface, double wavelength_m, double grazing_rad) {
  core::require_range("rms_slope", surface.rms_slope, {0.01, 1.0});
  core::require_range("grazing_rad", grazing_rad, {-core::kPi / 2.0, core::kPi / 2.0});
  const double coherent =
      coherent_power_factor(surface.rms_height_m, wavelength_m, core::kPi / 2.0);
  const double sin_grazing = std::sin(grazing_rad);
  if (grazing_rad <= 0.0) return 0.0;
  const double twice_slope2 = 2.0 * surface.rms_slope * surface.rms_slope;
  const double sin2 = sin_grazing * sin_grazing;
  // Below 0.6 deg the lobe is under exp(-4000) for every allowed slope, and its terms would
  // overflow.
  const double lobe =
      sin2 < 1e-4 ? 0.0
                  : std::exp(-(1.0 - sin2) / (sin2 * twice_slope2)) / (twice_slope2 * sin2 * sin2);
  return coherent * lobe + 2.0 * (1.0 - coherent) * sin_grazing;
}

}  // namespace fanbeam::materials
