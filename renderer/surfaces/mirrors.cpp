#include "renderer/surfaces/mirrors.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

using materials::Polarisation;

Mirrors::Mirrors(const std::vector<std::optional<materials::SpecularSurface>>& specular,
                 const std::vector<BistaticNrcs>& nrcs, double wavelength_m) {
  for (std::size_t material = 0; material < specular.size(); ++material) {
    tables_.emplace_back();
    if (!specular[material]) continue;
    std::vector<Sample>& table = tables_.back();
    double most = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double sine = static_cast<double>(i) / kSteps;
      const double grazing_rad = std::asin(sine);
      // What the surface does not scatter.
      const double left = material < nrcs.size() ? 1.0 - nrcs[material].scattered(sine) : 1.0;
      const auto power = [&](Polarisation polarisation) {
        return std::min(materials::specular_power_reflection(*specular[material], polarisation,
                                                             wavelength_m, grazing_rad),
                        left);
      };
      table.push_back({power(Polarisation::horizontal), power(Polarisation::vertical)});
      most = std::max({most, table.back()[0], table.back()[1]});
    }
    table.push_back(table.back());  // so that the right end needs no branch
    if (most > 0.0) {
      any_ = true;
    } else {
      table.clear();
    }
  }
}

}  // namespace fanbeam::renderer
