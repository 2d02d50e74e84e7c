#include "atmosphere/precipitation/rain_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/weather.h"

namespace fanbeam::atmosphere {

VerticalPrism prism_of(const RainCell& cell) {
  if (cell.radius_m > 0.0)
    return VerticalPrism::circular(cell.centre_m, cell.radius_m, cell.base_m, cell.top_m);
  return VerticalPrism::rectangular(cell.centre_m, cell.length_m, cell.width_m, cell.heading_rad,
                                    cell.base_m, cell.top_m);
}

RainCells::RainCells(const Weather& weather, double frequency_Hz) {
  problems_in(weather, frequency_Hz).throw_if_errors();
  if (!weather.simulate_rain) return;
  for (const RainCell& cell : weather.rain_cells)
    if (cell.rain_rate_mm_per_h > 0.0)
      cells_.push_back(
          {prism_of(cell), rain_dB_per_km(weather, cell.rain_rate_mm_per_h, frequency_Hz)});
}

bool RainCells::stand_between(const glm::dvec2& from_m, const glm::dvec2& to_m) const noexcept {
  return std::any_of(cells_.begin(), cells_.end(),
                     [&](const Cell& cell) { return cell.prism.stands_between(from_m, to_m); });
}

double RainCells::one_way_dB(const glm::dvec3& from_m, const glm::dvec3& to_m) const noexcept {
  double sum = 0.0;
  for (const Cell& cell : cells_) sum += cell.dB_per_km * cell.prism.chord_m(from_m, to_m);
  return 1e-3 * sum;
}

double RainCells::two_way_power_factor(const glm::dvec3& from_m,
                                       const glm::dvec3& to_m) const noexcept {
  constexpr double kNeperPer_dB = 0.2 * std::numbers::ln10;
  const double loss_dB = one_way_dB(from_m, to_m);
  return loss_dB == 0.0 ? 1.0 : std::exp(-kNeperPer_dB * loss_dB);
}

double RainCells::largest_one_way_dB(double length_m, int legs) const noexcept {
  double sum = 0.0;
  for (const Cell& cell : cells_)
    sum += cell.dB_per_km * std::min(length_m, legs * cell.prism.longest_chord_m());
  return 1e-3 * sum;
}

}  // namespace fanbeam::atmosphere
