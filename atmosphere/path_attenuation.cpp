#include "atmosphere/path_attenuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/gas/gases.h"
#include "atmosphere/gas/standard_atmosphere.h"

namespace fanbeam::atmosphere {
namespace {

// The gas profile bends over about 2 km: linear cells of this height are good to 2e-5 of it.
constexpr double kCellHeight_m = 25.0;

}  // namespace

class PathAttenuation::Builder {
 public:
  Builder(const Weather& weather, double frequency_Hz, PathAttenuation& result)
      : weather_(weather),
        frequency_Hz_(frequency_Hz),
        has_fog_(fog_liquid_water_g_per_m3(weather) > 0.0),
        fog_dB_per_km_(weather.simulate_fog ? fog_layer_dB_per_km(weather, frequency_Hz) : 0.0),
        rain_dB_per_km_(weather.simulate_rain ? rain_layer_dB_per_km(weather, frequency_Hz) : 0.0),
        air_({weather.origin_height_m, weather.temperature_C, weather.pressure_hPa,
              weather.humidity}),
        result_(result) {}

  void build() {
    result_.is_clear_ = !weather_.simulate_gas && fog_dB_per_km_ == 0.0 && rain_dB_per_km_ == 0.0;
    std::vector<double> borders = {kLowest_m, kHighest_m};
    if (has_fog_) borders.push_back(weather_.fog_top_m);
    if (rain_dB_per_km_ > 0.0) borders.push_back(weather_.rain_top_m);
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());

    add_outside(-HUGE_VAL, kLowest_m);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) add_layer(borders[i], borders[i + 1]);
    add_outside(kHighest_m, kHighest_m);
  }

 private:
  bool in_fog(double layer_start_m) const { return has_fog_ && layer_start_m < weather_.fog_top_m; }

  double gas_dB_per_km(double height_m, bool saturated) const {
    if (!weather_.simulate_gas) return 0.0;
    AirState air = air_.at(weather_.origin_height_m + height_m);
    if (saturated)
      air.vapour_density_g_per_m3 =
          saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa);
    return gas_attenuation(frequency_Hz_, air.dry_pressure_hPa(), air.temperature_K,
                           air.vapour_density_g_per_m3)
        .total_dB_per_km();
  }

  void add_layer(double start_m, double end_m) {
    const double height_m = end_m - start_m;
    const std::size_t cells =
        weather_.simulate_gas ? static_cast<std::size_t>(std::ceil(height_m / kCellHeight_m)) : 1;
    const double cell_count = static_cast<double>(cells);
    const bool saturated = in_fog(start_m);
    const Layer layer = begin_layer(start_m, cell_count / height_m, cells);
    double gas = gas_dB_per_km(start_m, saturated);
    double cell_start_m = start_m;
    for (std::size_t i = 1; i <= cells; ++i) {
      const double cell_end_m = start_m + height_m * (static_cast<double>(i) / cell_count);
      const double gas_at_end = gas_dB_per_km(cell_end_m, saturated);
      const double thickness_m = cell_end_m - cell_start_m;
      result_.cells_.push_back(
          {cell_start_m, gas, (gas_at_end - gas) / thickness_m, integral_dB_m_per_km_});
      integral_dB_m_per_km_ +=
          (0.5 * (gas + gas_at_end) + layer.fog_dB_per_km + layer.rain_dB_per_km) * thickness_m;
      gas = gas_at_end;
      cell_start_m = cell_end_m;
    }
  }

  // A single cell that goes on for ever with the value at its border.
  void add_outside(double start_m, double border_m) {
    begin_layer(start_m, 0.0, 1);
    const double gas = gas_dB_per_km(border_m, in_fog(start_m));
    result_.cells_.push_back({border_m, gas, 0.0, integral_dB_m_per_km_});
  }

  Layer begin_layer(double start_m, double cells_per_m, std::size_t cells) {
    const std::size_t first = result_.cells_.size();
    const double fog = in_fog(start_m) ? fog_dB_per_km_ : 0.0;
    const double rain = start_m < weather_.rain_top_m ? rain_dB_per_km_ : 0.0;
    result_.layers_.push_back({start_m, cells_per_m, first, first + cells - 1, fog, rain});
    return result_.layers_.back();
  }

  const Weather& weather_;
  double frequency_Hz_;
  bool has_fog_;
  double fog_dB_per_km_;
  double rain_dB_per_km_;
  StandardAtmosphere air_;
  double integral_dB_m_per_km_ = 0.0;
  PathAttenuation& result_;
};

PathAttenuation::PathAttenuation(const Weather& weather, double frequency_Hz) {
  problems_in(weather, frequency_Hz).throw_if_errors();
  Builder(weather, frequency_Hz, *this).build();
}

PathAttenuation::Location PathAttenuation::locate(double height_m) const noexcept {
  const Layer* layer = layers_.data();
  const Layer* const last = layer + (layers_.size() - 1);
  while (layer != last && height_m >= (layer + 1)->start_m) ++layer;
  // The layers outside have zero cells per metre; NaN from their infinite start becomes zero too.
  const double index = std::max(0.0, (height_m - layer->start_m) * layer->cells_per_m);
  return {layer, std::min(layer->first_cell + static_cast<std::size_t>(index), layer->last_cell)};
}

SpecificAttenuation PathAttenuation::profile(const Location& location,
                                             double height_m) const noexcept {
  const Cell& cell = cells_[location.cell];
  return {cell.gas_at_start_dB_per_km + cell.gas_slope_dB_per_km_m * (height_m - cell.start_m),
          location.layer->fog_dB_per_km, location.layer->rain_dB_per_km};
}

SpecificAttenuation PathAttenuation::one_way_attenuation_dB_per_km(double height_m) const noexcept {
  return profile(locate(height_m), height_m);
}

double PathAttenuation::one_way_dB(double from_height_m, double to_height_m,
                                   double length_m) const noexcept {
  if (is_clear_) return 0.0;
  const double low_m = std::min(from_height_m, to_height_m);
  const double high_m = std::max(from_height_m, to_height_m);
  const Location low = locate(low_m);
  const Location high = locate(high_m);
  // Within a cell the mean of a linear profile is its middle value: level paths divide by nothing.
  const auto mean = [this](const Location& in, double bottom_m, double top_m) {
    return profile(in, 0.5 * (bottom_m + top_m)).total_dB_per_km();
  };
  if (low.cell == high.cell) return mean(low, low_m, high_m) * (1e-3 * length_m);

  const Cell& above_low = cells_[low.cell + 1];
  const Cell& below_high = cells_[high.cell];
  const double integral_dB_m_per_km =
      mean(low, low_m, above_low.start_m) * (above_low.start_m - low_m) +
      (below_high.integral_at_start_dB_m_per_km - above_low.integral_at_start_dB_m_per_km) +
      mean(high, below_high.start_m, high_m) * (high_m - below_high.start_m);
  return integral_dB_m_per_km / (high_m - low_m) * (1e-3 * length_m);
}

double PathAttenuation::two_way_power_factor(double from_height_m, double to_height_m,
                                             double length_m) const noexcept {
  if (is_clear_) return 1.0;
  constexpr double kNeperPer_dB = 0.2 * std::numbers::ln10;
  return std::exp(-kNeperPer_dB * one_way_dB(from_height_m, to_height_m, length_m));
}

}  // namespace fanbeam::atmosphere
