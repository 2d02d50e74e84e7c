#include "apps/weather_options.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "atmosphere/air_column.h"
#include "atmosphere/gas/gases.h"
#include "core/constants.h"
#include "core/units.h"

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

// Refuses what was given when what came of it lies outside.
void require(double derived, double lowest, double highest, const char* option, double given,
             const std::string& expected) {
  if (derived >= lowest && derived <= highest) return;
  core::throw_input_error(
      std::isfinite(given) ? core::ErrorClass::range : core::ErrorClass::nonfinite, option, given,
      expected);
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

std::string text_of(const std::optional<double>& value) {
  return value ? core::number_text(*value) : std::string();
}

// P.676 takes dry pressure and vapour density, Weather total pressure and relative humidity.
void put_gases(const WeatherOptions& options, atmosphere::Weather& weather) {
  const auto& dry_hPa = options.dry_pressure_hPa;
  const auto& vapour_g_per_m3 = options.vapour_density_g_per_m3;
  if (!dry_hPa && !vapour_g_per_m3) return;
  if (!weather.levels.empty())
    core::throw_input_error(core::ErrorClass::range,
                            vapour_g_per_m3 ? "--vapour-density" : "--dry-pressure",
                            vapour_g_per_m3.value_or(*dry_hPa), "a scene without weather.level");
  const auto air = [&] { return atmosphere::AirColumn(weather).at(0.0); };
  if (dry_hPa) {
    // How much vapour a humidity means hangs on the pressure a little: a few rounds settle it.
    for (int i = 0; i < 3; ++i) {
      const atmosphere::AirState now = air();
      weather.pressure_hPa =
          *dry_hPa + atmosphere::vapour_pressure_hPa(
                         vapour_g_per_m3.value_or(now.vapour_density_g_per_m3), now.temperature_K);
      require(*weather.pressure_hPa, 300.0, 1100.0, "--dry-pressure", *dry_hPa,
              "300 to 1100 hPa together with the vapour's");
    }
  }
  if (!vapour_g_per_m3) return;
  const atmosphere::AirState now = air();
  const double saturated_g_per_m3 =
      atmosphere::saturation_vapour_density_g_per_m3(now.temperature_K, now.pressure_hPa);
  weather.humidity = *vapour_g_per_m3 / saturated_g_per_m3;
  require(*weather.humidity, 0.0, 1.0, "--vapour-density", *vapour_g_per_m3,
          fmt::format("0 to {:.4g} g/m3, where air of {:.4g} C is saturated", saturated_g_per_m3,
                      now.temperature_K - 273.15));
}

// Options, and what was given for them, of which that rain law alone knows.
std::array<std::pair<const char*, std::string>, 3> of_itu_p838(const WeatherOptions& options) {
  return {{{"--polarisation", options.polarisation},
           {"--tilt", text_of(options.tilt_deg)},
           {"--path-elevation", text_of(options.path_elevation_deg)}}};
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
  put_gases(options, weather);
  if (!options.polarisation.empty())
    weather.polarisation_tilt_rad = options.polarisation == "VV" ? core::kPi / 2.0 : 0.0;
  if (options.tilt_deg) weather.polarisation_tilt_rad = core::radians(*options.tilt_deg);
  if (options.path_elevation_deg)
    weather.rain_path_elevation_rad = core::radians(*options.path_elevation_deg);
}

void check_amounts(const WeatherOptions& options, const atmosphere::Weather& weather,
                   bool rain_cells, core::ProblemList& problems) {
  const auto need = [&](bool there, const char* option, const std::string& value,
                        const std::string& what) {
    if (!there && !value.empty())
      problems.error(core::ErrorClass::ref, {}, option, value,
                     what + " beside it, or a scene that has it");
  };
  // None of it is an amount too.
  const bool fog = weather.visibility_m || weather.liquid_water_g_per_m3;
  const bool rain = options.rain_mm_per_h || weather.rain_rate_mm_per_h > 0.0;
  const bool snow = options.snow_mm_per_h || weather.snow_rate_mm_per_h > 0.0;
  need(fog, "--fog-top", text_of(options.fog_top_m), "--fog-visibility or --fog-water");
  need(weather.visibility_m.has_value(), "--fog-type", options.fog_type, "--fog-visibility");
  need(fog, "--fog-law", options.fog_law, "--fog-visibility or --fog-water");
  need(rain, "--rain-top", text_of(options.rain_top_m), "--rain");
  need(rain || snow, "--melting-layer", options.melting_layer ? "given" : "", "--rain or --snow");
  need(rain || snow, "--melting-height", text_of(options.melting_height_m), "--rain or --snow");
  need(snow, "--snow-top", text_of(options.snow_top_m), "--snow");
  need(rain || rain_cells, "--rain-law", options.rain_law, "--rain");
  need(rain || rain_cells, "--rain-echo-law", options.rain_echo_law, "--rain");
  need(rain || rain_cells, "--drop-sizes", options.drop_sizes, "--rain");
  for (const auto& [option, value] : of_itu_p838(options))
    need(rain || rain_cells, option, value, "--rain");
}

void check_laws(const WeatherOptions& options, const atmosphere::Weather& weather,
                core::ProblemList& problems) {
  const std::string law(name_of(weather.rain_law)), echo_law(name_of(weather.rain_echo_law));
  const auto refuse = [&](const char* option, const std::string& value, const std::string& what) {
    if (!value.empty()) problems.error(core::ErrorClass::range, {}, option, value, what);
  };
  if (weather.rain_law != atmosphere::RainLaw::mie &&
      weather.rain_echo_law != atmosphere::RainEchoLaw::mie)
    refuse("--drop-sizes", options.drop_sizes,
           "the rain law or the rain echo law mie, as " + law + " and " + echo_law +
               " do not know it");
  if (weather.rain_law == atmosphere::RainLaw::itu_p838) return;
  for (const auto& [option, value] : of_itu_p838(options))
    refuse(option, value, "the rain law itu-p838, as " + law + " does not know it");
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
