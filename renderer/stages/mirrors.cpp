#include "renderer/stages/mirrors.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

using materials::Polarisation;

namespace {

// What the surface does not scatter, at the given number of equal steps of the sine; computed at
// every 32nd and linear between.
std::vector<double> left_to_mirror(const BistaticNrcs& nrcs, int steps) {
  constexpr int kStride = 32;
  std::vector<double> left(static_cast<std::size_t>(steps) + 1);
  double at_low = 0.0;
  for (int node = 0; node <= steps; node += kStride) {
    const double sine = std::max(static_cast<double>(node), 1.0) / steps;
    const double at_high = std::clamp(1.0 - scattered_share(nrcs, sine), 0.0, 1.0);
    for (int back = 0; back < kStride && node - back >= 0; ++back)
      left[static_cast<std::size_t>(node - back)] =
          at_high + (at_low - at_high) * static_cast<double>(back) / kStride;
    at_low = at_high;
  }
  return left;
}

}  // namespace

Mirrors::Mirrors(const std::vector<std::optional<materials::SpecularSurface>>& specular,
                 const std::vector<BistaticNrcs>& nrcs, double wavelength_m) {
  for (std::size_t material = 0; material < specular.size(); ++material) {
    tables_.emplace_back();
    if (!specular[material]) continue;
    std::vector<Sample>& table = tables_.back();
    std::vector<double> left(kSteps + 1, 1.0);
    if (material < nrcs.size()) left = left_to_mirror(nrcs[material], kSteps);
    double most = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double grazing_rad = std::asin(static_cast<double>(i) / kSteps);
      const auto power = [&](Polarisation polarisation) {
        return std::min(materials::specular_power_reflection(*specular[material], polarisation,
                                                             wavelength_m, grazing_rad),
                        left[static_cast<std::size_t>(i)]);
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
