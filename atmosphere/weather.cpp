#include "atmosphere/weather.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/air_column.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

// Liquid water of fog given by one of two amounts.
double liquid_water(const std::optional<double>& visibility_m, const std::optional<double>& water,
                    FogWaterModel model) {
  if (visibility_m && water)
    core::throw_input_error(core::ErrorClass::range, "liquid_water_g_per_m3", *water,
                            "no value beside visibility_m");
  if (visibility_m) return liquid_water_g_per_m3(model, *visibility_m);
  core::require_range("liquid_water_g_per_m3", water.value_or(0.0),
                      {0.0, kLargestLiquidWater_g_per_m3}, "g/m3");
  return water.value_or(0.0);
}

double water_in(const FogLayer& layer) {
  return liquid_water(layer.visibility_m, layer.liquid_water_g_per_m3, layer.water_model);
}

}  // namespace

double fog_liquid_water_g_per_m3(const Weather& weather) {
  return liquid_water(weather.visibility_m, weather.liquid_water_g_per_m3, weather.fog_water_model);
}

std::vector<FogLayer> fog_in(const Weather& weather) {
  std::vector<FogLayer> layers = {{weather.visibility_m, weather.liquid_water_g_per_m3,
                                   weather.fog_water_model, weather.fog_law, -HUGE_VAL,
                                   weather.fog_top_m}};
  layers.insert(layers.end(), weather.fog_layers.begin(), weather.fog_layers.end());
  std::erase_if(layers, [](const FogLayer& layer) { return water_in(layer) == 0.0; });
  return layers;
}

bool has_fog(const Weather& weather) { return !fog_in(weather).empty(); }

bool has_rain(const Weather& weather) {
  return weather.rain_rate_mm_per_h > 0.0 ||
         std::any_of(weather.rain_cells.begin(), weather.rain_cells.end(),
                     [](const RainCell& cell) { return cell.rain_rate_mm_per_h > 0.0; });
}

bool has_snow(const Weather& weather) { return weather.snow_rate_mm_per_h > 0.0; }

double fog_temperature_C(const Weather& weather, const FogLayer& layer) {
  const double height_m = layer.base_m > 0.0 ? (layer.base_m + layer.top_m) / 2 : 0.0;
  return AirColumn(weather).temperature_C(height_m);
}

double rain_temperature_C(const Weather& weather) {
  return std::clamp(AirColumn(weather).temperature_C(0.0), 0.0, 40.0);
}

RainDrops rain_drops(const Weather& weather) {
  return {weather.drop_sizes, rain_temperature_C(weather)};
}

double fog_layer_dB_per_km(const Weather& weather, const FogLayer& layer, double frequency_Hz) {
  return fog_attenuation_dB_per_km(layer.law, water_in(layer), frequency_Hz,
                                   fog_temperature_C(weather, layer));
}

double rain_dB_per_km(const Weather& weather, double rain_rate_mm_per_h, double frequency_Hz) {
  return rain_attenuation_dB_per_km(weather.rain_law, rain_rate_mm_per_h, frequency_Hz,
                                    weather.rain_path_elevation_rad, weather.polarisation_tilt_rad,
                                    rain_drops(weather));
}

PrecipitationLayers precipitation_layers(const Weather& weather) {
  PrecipitationLayers layers{weather.rain_top_m, false, -HUGE_VAL, weather.snow_top_m};
  if (!weather.melting_layer && !weather.melting_height_m) return layers;
  const double zero_m = weather.melting_height_m ? *weather.melting_height_m
                                                 : AirColumn(weather).zero_celsius_m().value();
  layers.melting = true;
  layers.rain_top_m = zero_m + kRainHeightAboveZeroC_m;
  layers.snow_base_m = layers.rain_top_m;
  return layers;
}

}  // namespace fanbeam::atmosphere
