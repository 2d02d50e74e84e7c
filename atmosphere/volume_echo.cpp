#include "atmosphere/volume_echo.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/precipitation/rain_cells.h"

namespace fanbeam::atmosphere {

VolumeEcho::VolumeEcho(const Weather& weather, double frequency_Hz) {
  problems_in(weather, frequency_Hz).throw_if_errors();
  layers_ = precipitation_layers(weather);
  const auto rain_eta = [&](double rate_mm_per_h) {
    return rain_eta_m2_per_m3(weather.rain_echo_law, rate_mm_per_h, frequency_Hz,
                              rain_drops(weather));
  };
  if (weather.rain_rate_mm_per_h > 0.0) rain_eta_m2_per_m3_ = rain_eta(weather.rain_rate_mm_per_h);
  if (has_snow(weather))
    snow_eta_m2_per_m3_ = snow_eta_m2_per_m3(weather.snow_rate_mm_per_h, frequency_Hz);
  for (const RainCell& cell : weather.rain_cells)
    if (cell.rain_rate_mm_per_h > 0.0)
      cells_.push_back({prism_of(cell), rain_eta(cell.rain_rate_mm_per_h)});
}

double VolumeEcho::layered_eta_m2_per_m3(double height_m) const noexcept {
  double eta = 0.0;
  if (rain_eta_m2_per_m3_ > 0.0) eta += rain_eta_m2_per_m3_ * layers_.rain_multiple(height_m);
  if (layers_.has_snow_at(height_m)) eta += snow_eta_m2_per_m3_;
  return eta;
}

double VolumeEcho::eta_m2_per_m3(const glm::dvec3& position_m) const noexcept {
  double eta = layered_eta_m2_per_m3(position_m.z);
  for (const Cell& cell : cells_)
    if (cell.prism.contains(position_m)) eta += cell.eta_m2_per_m3;
  return eta;
}

bool VolumeEcho::cells_between(const glm::dvec2& from_m, const glm::dvec2& to_m) const noexcept {
  return std::any_of(cells_.begin(), cells_.end(),
                     [&](const Cell& cell) { return cell.prism.stands_between(from_m, to_m); });
}

double VolumeEcho::largest_eta_m2_per_m3() const noexcept {
  return largest_eta_m2_per_m3(-HUGE_VAL, HUGE_VAL);
}

double VolumeEcho::largest_eta_m2_per_m3(double lowest_m, double highest_m) const noexcept {
  double rain = 0.0;
  if (rain_eta_m2_per_m3_ > 0.0 && lowest_m < layers_.rain_top_m)
    rain = rain_eta_m2_per_m3_ * (layers_.melting
                                      ? largest_melting_multiple(lowest_m - layers_.rain_top_m,
                                                                 highest_m - layers_.rain_top_m)
                                      : 1.0);
  const bool snow = lowest_m < layers_.snow_top_m && highest_m >= layers_.snow_base_m &&
                    layers_.snow_base_m < layers_.snow_top_m;
  // Rain and dry snow never share a height: the rain ends where the snow begins.
  double eta = std::max(rain, snow ? snow_eta_m2_per_m3_ : 0.0);
  for (const Cell& cell : cells_)
    if (lowest_m < cell.prism.top_m() && highest_m >= cell.prism.base_m())
      eta += cell.eta_m2_per_m3;
  return eta;
}

bool VolumeEcho::same_at_all_heights(double lowest_m, double highest_m) const noexcept {
  const auto between = [&](double border_m) {
    return lowest_m < border_m && border_m <= highest_m;
  };
  if (rain_eta_m2_per_m3_ > 0.0) {
    if (between(layers_.rain_top_m)) return false;
    const bool melts_there =
        lowest_m < layers_.rain_top_m && highest_m > layers_.rain_top_m - kMeltingDepth_m;
    if (layers_.melting && melts_there) return false;
  }
  if (snow_eta_m2_per_m3_ > 0.0 && (between(layers_.snow_base_m) || between(layers_.snow_top_m)))
    return false;
  return std::none_of(cells_.begin(), cells_.end(), [&](const Cell& cell) {
    return between(cell.prism.base_m()) || between(cell.prism.top_m());
  });
}

}  // namespace fanbeam::atmosphere
