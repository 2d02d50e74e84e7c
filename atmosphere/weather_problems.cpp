// What can be wrong with a Weather: the body of problems_in.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "atmosphere/air_column.h"
#include "atmosphere/gas/gases.h"
#include "atmosphere/gas/geopotential.h"
#include "atmosphere/input_check.h"
#include "atmosphere/weather.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr core::NumberRange kHeights{kLowestWeather_m, kHighestWeather_m};
constexpr const char* kHeightUnit = "m above the origin";

// Runs one check and keeps what it complains about, its fields below `prefix`.
template <typename Check>
void collect(core::ProblemList& problems, const std::string& prefix, Check check) {
  try {
    check();
  } catch (const core::InputError& error) {
    for (core::Problem problem : error.problems()) {
      problem.field = prefix + problem.field;
      problems.append({problem});
    }
  }
}

std::string entry(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "].";
}

std::string rounded(double value) { return core::number_text(std::round(10.0 * value) / 10.0); }

std::string whole_C(double temperature_K) {
  return core::number_text(std::round(temperature_K - kZeroCelsius_K));
}

void check_heights(core::ProblemList& problems, const std::string& prefix, double base_m,
                   double top_m) {
  core::check_range(problems, prefix + "base_m", base_m, kHeights, kHeightUnit);
  core::check_range(problems, prefix + "top_m", top_m, kHeights, kHeightUnit);
  if (base_m >= top_m)
    problems.error(core::ErrorClass::range, {}, prefix + "top_m", core::number_text(top_m),
                   "above base_m = " + core::number_text(base_m));
}

void check_fog_layers(core::ProblemList& problems, const Weather& weather) {
  for (std::size_t i = 0; i < weather.fog_layers.size(); ++i) {
    const FogLayer& layer = weather.fog_layers[i];
    const std::string prefix = entry("fog_layer", i);
    check_heights(problems, prefix, layer.base_m, layer.top_m);
    if (!layer.visibility_m && !layer.liquid_water_g_per_m3)
      problems.error(core::ErrorClass::ref, {}, prefix + "visibility_m", "missing",
                     "visibility_m or liquid_water_g_per_m3");
    Weather alone;
    alone.visibility_m = layer.visibility_m;
    alone.liquid_water_g_per_m3 = layer.liquid_water_g_per_m3;
    alone.fog_water_model = layer.water_model;
    collect(problems, prefix, [&] { fog_liquid_water_g_per_m3(alone); });
  }
}

void check_rain_cells(core::ProblemList& problems, const Weather& weather) {
  for (std::size_t i = 0; i < weather.rain_cells.size(); ++i) {
    const RainCell& cell = weather.rain_cells[i];
    const std::string prefix = entry("rain_cell", i);
    check_heights(problems, prefix, cell.base_m, cell.top_m);
    core::check_range(problems, prefix + "rain_rate_mm_per_h", cell.rain_rate_mm_per_h,
                      {0.0, kLargestRainRate_mm_per_h}, "mm/h");
    core::check_range(problems, prefix + "radius_m", cell.radius_m, {0.0, 1e5}, "m");
    core::check_range(problems, prefix + "length_m", cell.length_m, {0.0, 2e5}, "m");
    core::check_range(problems, prefix + "width_m", cell.width_m, {0.0, 2e5}, "m");
    core::check_range(problems, prefix + "heading_rad", cell.heading_rad,
                      {-2.0 * core::kPi, 2.0 * core::kPi}, "rad");
    if (cell.radius_m == 0.0 && (cell.length_m == 0.0 || cell.width_m == 0.0))
      problems.error(core::ErrorClass::ref, {}, prefix + "radius_m", "missing",
                     "radius_m, or length_m and width_m, above 0");
    core::check_range(problems, prefix + "east", cell.centre_m.x, {-1e6, 1e6}, "m");
    core::check_range(problems, prefix + "north", cell.centre_m.y, {-1e6, 1e6}, "m");
  }
}

void check_levels(core::ProblemList& problems, const Weather& weather) {
  for (std::size_t i = 0; i < weather.levels.size(); ++i) {
    const AirLevel& level = weather.levels[i];
    const std::string prefix = entry("level", i);
    core::check_range(problems, prefix + "height_m", level.height_m, kHeights, kHeightUnit);
    core::check_range(problems, prefix + "temperature_C", level.temperature_C, {-90.0, 50.0}, "C");
    core::check_range(problems, prefix + "humidity", level.humidity, {0.0, 1.0});
    if (level.pressure_hPa)
      core::check_range(problems, prefix + "pressure_hPa", *level.pressure_hPa, {100.0, 1100.0},
                        "hPa");
    if (level.pressure_hPa && weather.pressure_hPa)
      problems.error(core::ErrorClass::range, {}, prefix + "pressure_hPa",
                     core::number_text(*level.pressure_hPa),
                     "no value beside weather.pressure_hPa");
    if (i > 0 && level.height_m <= weather.levels[i - 1].height_m)
      problems.error(core::ErrorClass::range, {}, prefix + "height_m",
                     core::number_text(level.height_m), "above the level before");
  }
  if (weather.levels.empty()) return;
  if (weather.temperature_C)
    problems.error(core::ErrorClass::range, {}, "temperature_C",
                   core::number_text(*weather.temperature_C), "no value beside levels");
  if (weather.humidity)
    problems.error(core::ErrorClass::range, {}, "humidity", core::number_text(*weather.humidity),
                   "no value beside levels");
}

// Levels that are right by themselves may still make air that no gas law takes, also beyond them or
// once fog saturates it: told of the level it follows from.
void check_air(core::ProblemList& problems, const Weather& weather) {
  const AirColumn column(weather);
  const auto told = [&](std::size_t i, double height_m) {
    const AirState air = column.at(height_m);
    const AirLevel& level = weather.levels[i];
    const std::string there = core::number_text(height_m) + " m, not of ";
    const auto tell = [&](const char* key, double value, const std::string& expected) {
      problems.error(core::ErrorClass::range, {}, entry("level", i) + key, core::number_text(value),
                     expected);
      return true;
    };
    if (!kGasTemperatures_K.holds(air.temperature_K))
      return tell("temperature_C", level.temperature_C,
                  "air of " + whole_C(kGasTemperatures_K.low) + " to " +
                      whole_C(kGasTemperatures_K.high) + " C at " + there +
                      rounded(air.temperature_K - kZeroCelsius_K));
    const double least_hPa = vapour_pressure_hPa(
        saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa), air.temperature_K);
    if (air.pressure_hPa >= least_hPa && air.pressure_hPa <= kGasPressures_hPa.high) return false;
    const std::string expected = "air of " + rounded(least_hPa) + ", its saturated vapour, to " +
                                 rounded(kGasPressures_hPa.high) + " hPa at " + there +
                                 rounded(air.pressure_hPa);
    return level.pressure_hPa ? tell("pressure_hPa", *level.pressure_hPa, expected)
                              : tell("temperature_C", level.temperature_C, expected);
  };
  std::vector<std::pair<std::size_t, double>> places = {{0, kLowestWeather_m}};
  for (const AirLevel& level : weather.levels)
    places.emplace_back(places.size() - 1, level.height_m);
  places.emplace_back(weather.levels.size() - 1, kHighestWeather_m);
  std::size_t wrong = weather.levels.size();  // told of already
  for (const auto& [i, height_m] : places)
    if (i != wrong && told(i, height_m)) wrong = i;
}

void check_snow(core::ProblemList& problems, const Weather& weather) {
  core::check_range(problems, "snow_rate_mm_per_h", weather.snow_rate_mm_per_h,
                    {0.0, kLargestSnowRate_mm_per_h}, "mm/h");
  core::check_range(problems, "snow_top_m", weather.snow_top_m, kHeights, kHeightUnit);
  if (weather.melting_height_m)
    core::check_range(problems, "melting_height_m", *weather.melting_height_m,
                      {kLowestWeather_m, kHighestWeather_m - kRainHeightAboveZeroC_m},
                      "m above the origin");
  if (weather.snow_rate_mm_per_h > 0.0 && weather.rain_rate_mm_per_h > 0.0 &&
      !weather.melting_layer && !weather.melting_height_m)
    problems.error(core::ErrorClass::range, {}, "snow_rate_mm_per_h",
                   core::number_text(weather.snow_rate_mm_per_h),
                   "a melting layer between rain and snow (melting_layer or melting_height_m)");
}

// Values that are right by themselves may still be outside what a law accepts together.
void check_laws(core::ProblemList& problems, const Weather& weather, double frequency_Hz) {
  const auto laws_of = [&](const std::string& prefix, const FogLayer& layer) {
    collect(problems, prefix, [&] {
      if (layer.visibility_m || layer.liquid_water_g_per_m3.value_or(0.0) > 0.0)
        fog_layer_dB_per_km(weather, layer, frequency_Hz);
    });
  };
  laws_of("", {weather.visibility_m, weather.liquid_water_g_per_m3, weather.fog_water_model,
               weather.fog_law, kLowestWeather_m, weather.fog_top_m});
  for (std::size_t i = 0; i < weather.fog_layers.size(); ++i)
    laws_of(entry("fog_layer", i), weather.fog_layers[i]);
  const bool melts = weather.melting_layer && !weather.melting_height_m;
  const std::optional<double> zero_m =
      melts ? AirColumn(weather).zero_celsius_m() : std::optional<double>(0.0);
  if (!zero_m || *zero_m > kHighestWeather_m - kRainHeightAboveZeroC_m)
    problems.error(core::ErrorClass::range, {}, "melting_layer", "no 0 C level in the air",
                   "air that is above 0 C below and under 0 C above, or melting_height_m");
  // The Mie laws take every frequency, rate and temperature that gets here.
  if (weather.rain_law != RainLaw::mie)
    collect(problems, "",
            [&] { rain_dB_per_km(weather, weather.rain_rate_mm_per_h, frequency_Hz); });
  const auto echo_of = [&](const std::string& prefix, double rate_mm_per_h) {
    if (weather.rain_echo_law == RainEchoLaw::mie || rate_mm_per_h == 0.0) return;
    collect(problems, prefix,
            [&] { rain_eta_m2_per_m3(weather.rain_echo_law, rate_mm_per_h, frequency_Hz); });
  };
  echo_of("", weather.rain_rate_mm_per_h);
  for (std::size_t i = 0; i < weather.rain_cells.size(); ++i)
    echo_of(entry("rain_cell", i), weather.rain_cells[i].rain_rate_mm_per_h);
  if (!has_snow(weather)) return;
  collect(problems, "",
          [&] { snow_attenuation_dB_per_km(weather.snow_rate_mm_per_h, frequency_Hz); });
  collect(problems, "", [&] { snow_eta_m2_per_m3(weather.snow_rate_mm_per_h, frequency_Hz); });
  const double ground_C = AirColumn(weather).temperature_C(0.0);
  if (!weather.melting_layer && !weather.melting_height_m && ground_C > 2.0)
    problems.warning("WARM-SNOW", {}, "snow_rate_mm_per_h",
                     "dry snow in air of " + rounded(ground_C) + " C at the origin",
                     "simulated as dry snow all the same; set temperature_C or a melting layer");
}

}  // namespace

core::ProblemList problems_in(const Weather& weather, double frequency_Hz) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, kWeatherFrequencies_Hz.low, kWeatherFrequencies_Hz.high);
  collect(problems, "", [&] {
    StandardAtmosphere(
        {weather.origin_height_m, weather.temperature_C, weather.pressure_hPa, weather.humidity});
  });
  core::check_range(problems, "fog_top_m", weather.fog_top_m, kHeights, kHeightUnit);
  core::check_range(problems, "rain_top_m", weather.rain_top_m, kHeights, kHeightUnit);
  collect(problems, "", [&] { fog_liquid_water_g_per_m3(weather); });
  core::check_range(problems, "rain_rate_mm_per_h", weather.rain_rate_mm_per_h,
                    {0.0, kLargestRainRate_mm_per_h}, "mm/h");
  core::check_range(problems, "polarisation_tilt_rad", weather.polarisation_tilt_rad,
                    {-core::kPi, core::kPi}, "rad");
  core::check_range(problems, "rain_path_elevation_rad", weather.rain_path_elevation_rad,
                    {-core::kPi / 2.0, core::kPi / 2.0}, "rad");
  check_fog_layers(problems, weather);
  check_rain_cells(problems, weather);
  check_levels(problems, weather);
  check_snow(problems, weather);
  if (!problems.has_errors() && !weather.levels.empty()) check_air(problems, weather);
  if (!problems.has_errors()) check_laws(problems, weather, frequency_Hz);
  return problems;
}

}  // namespace fanbeam::atmosphere
