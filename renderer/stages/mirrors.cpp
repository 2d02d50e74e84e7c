#include "renderer/stages/mirrors.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

using materials::Polarisation;

Mirrors::Mirrors(const std::vector<std::optional<materials::SpecularSurface>>& specular,
                 double wavelength_m) {
  for (const std::optional<materials::SpecularSurface>& surface : specular) {
    tables_.emplace_back();
    if (!surface) continue;
    std::vector<Sample>& table = tables_.back();
    double most = 0.0;
    for (int i = 0; i <= kSteps + 1; ++i) {
      const double grazing_rad = std::asin(std::min(static_cast<double>(i) / kSteps, 1.0));
      const auto power = [&](Polarisation polarisation) {
        return materials::specular_power_reflection(*surface, polarisation, wavelength_m,
                                                    grazing_rad);
      };
      table.push_back({power(Polarisation::horizontal), power(Polarisation::vertical)});
      most = std::max({most, table.back()[0], table.back()[1]});
    }
    if (most > 0.0) {
      any_ = true;
    } else {
      table.clear();
    }
  }
}

}  // namespace fanbeam::renderer
