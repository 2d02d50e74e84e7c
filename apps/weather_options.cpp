#include "apps/weather_options.h"

#include "core/constants.h"

namespace fanbeam::apps {
namespace {

void put_fog(const WeatherOptions& options, atmosphere::Weather& weather) {
  if (options.visibility_m || options.liquid_water_g_per_m3) {
    weather.visibility_m = options.visibility_m;
    weather.liquid_water_g_per_m3 = options.liquid_water_g_per_m3;
  }
  if (options.fog_top_m) weather.fog_top_m = *options.fog_top_m;
  if (!options.fog_type.empty())
    weather.fog_water_model = atmosphere::fog_water_model_named(options.fog_type);
  if (!options.fog_law.empty()) weather.fog_law = atmosphere::fog_law_named(options.fog_law);
}

// A top of the rain and a melting layer replace each other.
void put_rain(const WeatherOptions& options, atmosphere::Weather& weather) {
  if (options.rain_mm_per_h) weather.rain_rate_mm_per_h = *options.rain_mm_per_h;
  if (options.rain_top_m) {
    weather.rain_top_m = *options.rain_top_m;
    weather.melting_layer = false;
    weather.melting_height_m.reset();
  }
  if (options.melting_layer || options.melting_height_m) {
    weather.melting_layer = true;
    weather.melting_height_m = options.melting_height_m;
  }
  if (!options.rain_law.empty()) weather.rain_law = atmosphere::rain_law_named(options.rain_law);
  if (!options.rain_echo_law.empty())
    weather.rain_echo_law = atmosphere::rain_echo_law_named(options.rain_echo_law);
  if (!options.drop_sizes.empty())
    weather.drop_sizes = atmosphere::drop_sizes_named(options.drop_sizes);
}

}  // namespace

void put_over(const WeatherOptions& options, atmosphere::Weather& weather) {
  put_fog(options, weather);
  put_rain(options, weather);
  if (options.snow_mm_per_h) weather.snow_rate_mm_per_h = *options.snow_mm_per_h;
  if (options.snow_top_m) weather.snow_top_m = *options.snow_top_m;
  if (options.temperature_C) weather.temperature_C = options.temperature_C;
  if (options.humidity) weather.humidity = options.humidity;
  if (options.pressure_hPa) weather.pressure_hPa = options.pressure_hPa;
  if (!options.polarisation.empty())
    weather.polarisation_tilt_rad = options.polarisation == "VV" ? core::kPi / 2.0 : 0.0;
}

std::string option_behind(const WeatherOptions& options, const std::string& field) {
  struct Row {
    const char* field;
    const char* option;
    bool given;
  };
  const Row rows[] = {
      {"visibility_m", "--fog-visibility", options.visibility_m.has_value()},
      {"liquid_water_g_per_m3", "--fog-water", options.liquid_water_g_per_m3.has_value()},
      {"fog_top_m", "--fog-top", options.fog_top_m.has_value()},
      {"rain_rate_mm_per_h", "--rain", options.rain_mm_per_h.has_value()},
      {"rain_top_m", "--rain-top", options.rain_top_m.has_value()},
      {"melting_layer", "--melting-layer", options.melting_layer},
      {"melting_height_m", "--melting-height", options.melting_height_m.has_value()},
      {"snow_rate_mm_per_h", "--snow", options.snow_mm_per_h.has_value()},
      {"snow_top_m", "--snow-top", options.snow_top_m.has_value()},
      {"temperature_C", "--temperature", options.temperature_C.has_value()},
      {"humidity", "--humidity", options.humidity.has_value()},
      {"pressure_hPa", "--pressure", options.pressure_hPa.has_value()}};
  for (const Row& row : rows)
    if (row.given && field == row.field) return row.option;
  return {};
}

}  // namespace fanbeam::apps
