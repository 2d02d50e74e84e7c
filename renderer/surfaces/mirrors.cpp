#include "renderer/surfaces/mirrors.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace fanbeam::renderer {

using materials::Polarisation;

Mirrors::Mirrors(const std::vector<std::optional<materials::SpecularSurface>>& specular,
                 const std::vector<BistaticNrcs>& nrcs, double wavelength_m) {
  tables_.resize(specular.size());
  core::parallel_for(specular.size(), [&](std::size_t material) {
    if (!specular[material]) return;
    std::vector<Sample>& table = tables_[material];
    double most = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double sine = static_cast<double>(i) / kSteps;
      const double grazing_rad = std::asin(sine);
      const double left = material < nrcs.size() ? nrcs[material].unscattered(sine) : 1.0;
      const auto power = [&](Polarisation polarisation) {
        return std::min(materials::specular_power_reflection(*specular[material], polarisation,
                                                             wavelength_m, grazing_rad),
                        left);
      };
      table.push_back({power(Polarisation::horizontal), power(Polarisation::vertical)});
      most = std::max({most, table.back()[0], table.back()[1]});
    }
    table.push_back(table.back());  // so that the right end needs no branch
    if (most == 0.0) table.clear();
  });
  any_ = std::any_of(tables_.begin(), tables_.end(),
                     [](const std::vector<Sample>& table) { return !table.empty(); });
}

}  // namespace fanbeam::renderer
