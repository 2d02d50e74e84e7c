// How much of a wave each material of a world reflects like a mirror, made quick for the ray loop.
//
//     rho = |Gamma_s|^2 c + |Gamma_p|^2 (1 - c),  times the coherent factor of the roughness
// with Gamma of materials/dielectric/specular_surface.h and c the share of the wave's power whose
// field stands perpendicular to the plane of incidence. The two parts do not interfere here: the
// turn of polarisation at oblique planes is neglected. What a surface scatters it cannot mirror:
// rho is at most one less the scattered share of bistatic_nrcs.h. Sheet metal whose reflectivity
// is that of a rough mirror (all power in a lobe) is so kept from being a smooth mirror as well.
// Linear interpolation between 1024 steps of the sine of the grazing angle; by the second
// derivative of the roughness factor 1.3e-5 absolute for rms heights of 5 mm at 35 GHz, 5e-4 for
// 30 mm. Metal in vertical polarisation turns below 0.06 deg, inside the first step.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/dielectric/specular_surface.h"
#include "renderer/surfaces/bistatic_nrcs.h"
#include "terrain/height_field.h"

namespace fanbeam::renderer {

class Mirrors {
 public:
  // By material id; materials beyond the end, and empty ones, do not reflect.
  Mirrors(const std::vector<std::optional<materials::SpecularSurface>>& specular,
          const std::vector<BistaticNrcs>& nrcs, double wavelength_m);

  // False when nothing reflects at any angle.
  bool any() const { return any_; }

  // Sine 0 to 1; `perpendicular_share` is c.
  double power(terrain::MaterialId material, double sin_grazing,
               double perpendicular_share) const noexcept {
    if (material >= tables_.size() || tables_[material].empty()) return 0.0;
    const double position = sin_grazing * kSteps;
    const auto index = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(index);
    const Sample& a = tables_[material][index];
    const Sample& b = tables_[material][index + 1];
    const double perpendicular = a[0] + share * (b[0] - a[0]);
    const double parallel = a[1] + share * (b[1] - a[1]);
    return parallel + perpendicular_share * (perpendicular - parallel);
  }

 private:
  static constexpr int kSteps = 1024;
  using Sample = std::array<double, 2>;  // perpendicular, parallel
  std::vector<std::vector<Sample>> tables_;
  bool any_ = false;
};

}  // namespace fanbeam::renderer
