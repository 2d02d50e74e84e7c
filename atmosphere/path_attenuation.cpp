#include "atmosphere/path_attenuation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atmosphere/air_column.h"
#include "atmosphere/gas/gases.h"

namespace fanbeam::atmosphere {
namespace {

// The gas profile bends over about 2 km: linear cells of this height are good to 2e-5 of it. The
// melting layer bends over 70 m.
constexpr double kCellHeight_m = 25.0;
constexpr double kMeltingCellHeight_m = 2.5;

}  // namespace

class PathAttenuation::Builder {
 public:
  Builder(const Weather& weather, double frequency_Hz, PathAttenuation& result)
      : weather_(weather),
        frequency_Hz_(frequency_Hz),
        precipitation_(precipitation_layers(weather)),
        air_(weather),
        result_(result) {
    for (const FogLayer& layer : fog_in(weather))
      fog_.push_back(
          {layer.base_m, layer.top_m,
           weather.simulate_fog ? fog_layer_dB_per_km(weather, layer, frequency_Hz) : 0.0});
    if (weather.simulate_rain && weather.rain_rate_mm_per_h > 0.0)
      rain_dB_per_km_ = rain_dB_per_km(weather, weather.rain_rate_mm_per_h, frequency_Hz);
    if (weather.simulate_snow && has_snow(weather))
      snow_dB_per_km_ = snow_attenuation_dB_per_km(weather.snow_rate_mm_per_h, frequency_Hz);
  }

  void build() {
    const std::vector<double> borders = layer_borders();
    add_outside(std::numeric_limits<double>::lowest(), kLowest_m);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) add_layer(borders[i], borders[i + 1]);
    add_outside(kHighest_m, kHighest_m);
    result_.is_clear_ =
        std::all_of(result_.cells_.begin(), result_.cells_.end(), [](const Cell& cell) {
          return cell.at_start_dB_per_km == 0.0 && cell.slope_dB_per_km_m == 0.0;
        });
  }

 private:
  struct Fog {
    double base_m, top_m, dB_per_km;
    bool holds(double height_m) const { return height_m >= base_m && height_m < top_m; }
  };

  std::vector<double> layer_borders() const {
    std::vector<double> borders = {kLowest_m, kHighest_m};
    for (const Fog& fog : fog_) borders.insert(borders.end(), {fog.base_m, fog.top_m});
    if (rain_dB_per_km_ > 0.0) borders.push_back(precipitation_.rain_top_m);
    if (melts()) borders.push_back(precipitation_.rain_top_m - kMeltingDepth_m);
    if (snow_dB_per_km_ > 0.0)
      borders.insert(borders.end(), {precipitation_.snow_base_m, precipitation_.snow_top_m});
    for (double& border : borders) border = std::clamp(border, kLowest_m, kHighest_m);
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    return borders;
  }

  bool melts() const { return rain_dB_per_km_ > 0.0 && precipitation_.melting; }

  bool melts_between(double start_m, double end_m) const {
    return melts() && end_m <= precipitation_.rain_top_m &&
           start_m >= precipitation_.rain_top_m - kMeltingDepth_m;
  }

  double gas_dB_per_km(double height_m, bool saturated) const {
    if (!weather_.simulate_gas) return 0.0;
    AirState air = air_.at(height_m);
    if (saturated)
      air.vapour_density_g_per_m3 =
          saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa);
    const GasAttenuation gas = gas_attenuation(frequency_Hz_, air.dry_pressure_hPa(),
                                               air.temperature_K, air.vapour_density_g_per_m3);
    if (weather_.gas_part == GasPart::oxygen) return gas.oxygen_dB_per_km;
    if (weather_.gas_part == GasPart::vapour) return gas.water_dB_per_km;
    return gas.total_dB_per_km();
  }

  // Of the layer that holds `inside_m`: its limits at the borders, not the values beyond them.
  double rain_at(double height_m, double inside_m) const {
    if (rain_dB_per_km_ == 0.0 || inside_m >= precipitation_.rain_top_m) return 0.0;
    if (!precipitation_.melting || inside_m < precipitation_.rain_top_m - kMeltingDepth_m)
      return rain_dB_per_km_;
    return rain_dB_per_km_ * melting_multiple(std::clamp(height_m - precipitation_.rain_top_m,
                                                         -kMeltingDepth_m, 0.0));
  }

  void add_layer(double start_m, double end_m) {
    const double height_m = end_m - start_m;
    const double finest_m = melts_between(start_m, end_m) ? kMeltingCellHeight_m : kCellHeight_m;
    const bool uniform = !weather_.simulate_gas && !melts_between(start_m, end_m);
    const std::size_t cells =
        uniform ? 1 : static_cast<std::size_t>(std::ceil(height_m / finest_m));
    const double middle_m = (start_m + end_m) / 2;
    begin_layer(start_m, middle_m, static_cast<double>(cells) / height_m, cells);
    double gas = gas_dB_per_km(start_m, saturated_at(middle_m));
    double rain = rain_at(start_m, middle_m);
    double cell_start_m = start_m;
    for (std::size_t i = 1; i <= cells; ++i) {
      const double cell_end_m =
          start_m + height_m * (static_cast<double>(i) / static_cast<double>(cells));
      const double gas_at_end = gas_dB_per_km(cell_end_m, saturated_at(middle_m));
      const double rain_at_end = rain_at(cell_end_m, middle_m);
      add_cell(cell_start_m, cell_end_m - cell_start_m, gas, gas_at_end, rain, rain_at_end);
      gas = gas_at_end;
      rain = rain_at_end;
      cell_start_m = cell_end_m;
    }
  }

  // A single cell that goes on for ever with the value at its border.
  void add_outside(double start_m, double border_m) {
    begin_layer(start_m, border_m, 0.0, 1);
    const double gas = gas_dB_per_km(border_m, saturated_at(border_m));
    const double rain = rain_at(border_m, border_m);
    add_cell(border_m, 0.0, gas, gas, rain, rain);
  }

  bool saturated_at(double height_m) const {
    return std::any_of(fog_.begin(), fog_.end(),
                       [&](const Fog& fog) { return fog.holds(height_m); });
  }

  void begin_layer(double start_m, double inside_m, double cells_per_m, std::size_t cells) {
    const std::size_t first = result_.cells_.size();
    double fog_dB_per_km = 0.0;
    for (const Fog& fog : fog_)
      if (fog.holds(inside_m)) fog_dB_per_km += fog.dB_per_km;
    const double snow = precipitation_.has_snow_at(inside_m) ? snow_dB_per_km_ : 0.0;
    result_.layers_.push_back(
        {start_m, cells_per_m, first, first + cells - 1, fog_dB_per_km, snow});
  }

  void add_cell(double start_m, double thickness_m, double gas, double gas_at_end, double rain,
                double rain_at_end) {
    const Layer& layer = result_.layers_.back();
    const double uniform = layer.fog_dB_per_km + layer.snow_dB_per_km;
    const double per_m = thickness_m > 0.0 ? 1.0 / thickness_m : 0.0;
    const double gas_slope = (gas_at_end - gas) * per_m;
    const double rain_slope = (rain_at_end - rain) * per_m;
    result_.cells_.push_back(
        {start_m, gas + rain + uniform, gas_slope + rain_slope, integral_dB_m_per_km_});
    result_.causes_.push_back({gas, gas_slope, rain, rain_slope});
    integral_dB_m_per_km_ +=
        (0.5 * (gas + gas_at_end) + 0.5 * (rain + rain_at_end) + uniform) * thickness_m;
  }

  const Weather& weather_;
  double frequency_Hz_;
  std::vector<Fog> fog_;  // at 0 dB/km where only its saturated air counts
  double rain_dB_per_km_ = 0.0;
  double snow_dB_per_km_ = 0.0;
  PrecipitationLayers precipitation_;
  AirColumn air_;
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
  // The layers outside have zero cells per metre; the lowest starts at the lowest finite number, as
  // zero times an infinite height would be NaN.
  const double index = std::max(0.0, (height_m - layer->start_m) * layer->cells_per_m);
  return {layer, std::min(layer->first_cell + static_cast<std::size_t>(index), layer->last_cell)};
}

SpecificAttenuation PathAttenuation::one_way_attenuation_dB_per_km(double height_m) const noexcept {
  const Location location = locate(height_m);
  const CellCauses& causes = causes_[location.cell];
  const double above_start_m = height_m - cells_[location.cell].start_m;
  return {causes.gas_at_start_dB_per_km + causes.gas_slope_dB_per_km_m * above_start_m,
          location.layer->fog_dB_per_km,
          causes.rain_at_start_dB_per_km + causes.rain_slope_dB_per_km_m * above_start_m,
          location.layer->snow_dB_per_km};
}

double PathAttenuation::largest_one_way_dB_per_km(double lowest_m,
                                                  double highest_m) const noexcept {
  const Location low = locate(lowest_m);
  const Location high = locate(highest_m);
  double largest =
      std::max(total_dB_per_km(low.cell, lowest_m), total_dB_per_km(high.cell, highest_m));
  // Linear in each cell: the ends of the cells are enough.
  for (std::size_t cell = low.cell + 1; cell <= high.cell; ++cell)
    largest = std::max({largest, cells_[cell].at_start_dB_per_km,
                        total_dB_per_km(cell - 1, cells_[cell].start_m)});
  return largest;
}

double PathAttenuation::one_way_dB(double from_height_m, double to_height_m,
                                   double length_m) const noexcept {
  if (is_clear_) return 0.0;
  const double low_m = std::min(from_height_m, to_height_m);
  const double high_m = std::max(from_height_m, to_height_m);
  const std::size_t low = locate(low_m).cell;
  const std::size_t high = locate(high_m).cell;
  // Within a cell the mean of a linear profile is its middle value: level paths divide by nothing.
  const auto mean = [this](std::size_t cell, double bottom_m, double top_m) {
    return total_dB_per_km(cell, 0.5 * (bottom_m + top_m));
  };
  if (low == high) return mean(low, low_m, high_m) * (1e-3 * length_m);

  const Cell& above_low = cells_[low + 1];
  const Cell& below_high = cells_[high];
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
