#include "scenes/weather_reader.h"

#include <algorithm>

#include "core/units.h"

namespace fanbeam::scenes {

using core::ConfigTable;
using core::radians;

void read_weather(ConfigTable& root, const SceneDescription& scene, atmosphere::Weather& weather) {
  ConfigTable table = root.table("weather");
  weather.visibility_m = table.optional_number("visibility_m", {10, 100000});
  weather.liquid_water_g_per_m3 = table.optional_number("liquid_water_g_per_m3", {0, 20});
  const auto named = [&](const char* key, const char* fallback, auto parse, auto& into) {
    try {
      into = parse(table.text(key, fallback));
    } catch (const core::InputError& error) {
      for (const core::Problem& problem : error.problems())
        table.error(core::ErrorClass::ref, key, problem.value, problem.expected);
    }
  };
  named("fog_type", "kunkel", atmosphere::fog_water_model_named, weather.fog_water_model);
  named("fog_law", "itu-p840", atmosphere::fog_law_named, weather.fog_law);
  named("rain_law", "itu-p838", atmosphere::rain_law_named, weather.rain_law);
  weather.fog_top_m = table.number("fog_top_m", {-2000, 12000}, weather.fog_top_m);
  weather.rain_rate_mm_per_h = table.number("rain_rate_mm_per_h", {0, 300}, 0.0);
  weather.rain_top_m = table.number("rain_top_m", {-2000, 12000}, weather.rain_top_m);
  weather.polarisation_tilt_rad = radians(table.number("polarisation_tilt_deg", {-180, 180}, 0.0));
  weather.origin_height_m = table.number("origin_height_m", {-500, 6000},
                                         std::clamp(scene.origin.height_m, -500.0, 6000.0));
  weather.temperature_C = table.optional_number("temperature_C", {-60, 50});
  weather.pressure_hPa = table.optional_number("pressure_hPa", {300, 1100});
  weather.humidity = table.optional_number("humidity", {0, 1});
  if (!(scene.sensor.waveform.frequency_Hz > 0.0)) return;  // no usable sensor: already reported
  const core::ProblemList found =
      atmosphere::problems_in(weather, scene.sensor.waveform.frequency_Hz);
  // A value outside the range was reported with its line already and replaced by its default.
  for (const core::Problem& problem : found.all()) {
    core::Problem placed = problem;
    placed.field = "weather." + problem.field;
    placed.place = table.place(problem.field);
    table.problems().append({placed});
  }
}

}  // namespace fanbeam::scenes
