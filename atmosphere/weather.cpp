#include "atmosphere/weather.h"

#include "atmosphere/gas/standard_atmosphere.h"
#include "atmosphere/input_check.h"
#include "atmosphere/path_attenuation.h"
#include "core/constants.h"

namespace fanbeam::atmosphere {
namespace {

// Runs one check and keeps what it complains about.
template <typename Check>
void collect(core::ProblemList& problems, Check check) {
  try {
    check();
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
}

}  // namespace

double fog_liquid_water_g_per_m3(const Weather& weather) {
  if (weather.visibility_m && weather.liquid_water_g_per_m3)
    core::throw_input_error(core::ErrorClass::range, "liquid_water_g_per_m3",
                            *weather.liquid_water_g_per_m3, "no value beside visibility_m");
  if (weather.visibility_m)
    return liquid_water_g_per_m3(weather.fog_water_model, *weather.visibility_m);
  const double liquid_water = weather.liquid_water_g_per_m3.value_or(0.0);
  require_range("liquid_water_g_per_m3", liquid_water, {0.0, kLargestLiquidWater_g_per_m3, "g/m3"});
  return liquid_water;
}

double fog_temperature_C(const Weather& weather) {
  if (weather.temperature_C) return *weather.temperature_C;
  return StandardAtmosphere().at(weather.origin_height_m).temperature_K - 273.15;
}

double fog_layer_dB_per_km(const Weather& weather, double frequency_Hz) {
  const double liquid_water = fog_liquid_water_g_per_m3(weather);
  if (liquid_water == 0.0) return 0.0;
  return fog_attenuation_dB_per_km(weather.fog_law, liquid_water, frequency_Hz,
                                   fog_temperature_C(weather));
}

double rain_layer_dB_per_km(const Weather& weather, double frequency_Hz) {
  constexpr double kLevelPath_rad = 0.0;
  return rain_attenuation_dB_per_km(weather.rain_law, weather.rain_rate_mm_per_h, frequency_Hz,
                                    kLevelPath_rad, weather.polarisation_tilt_rad);
}

core::ProblemList problems_in(const Weather& weather, double frequency_Hz) {
  core::ProblemList problems;
  check_range(problems, "frequency_Hz", frequency_Hz, {1e9, 1e12, "Hz"});
  collect(problems, [&] {
    StandardAtmosphere(
        {weather.origin_height_m, weather.temperature_C, weather.pressure_hPa, weather.humidity});
  });
  const Range tops{PathAttenuation::kLowest_m, PathAttenuation::kHighest_m, "m above the origin"};
  check_range(problems, "fog_top_m", weather.fog_top_m, tops);
  check_range(problems, "rain_top_m", weather.rain_top_m, tops);
  collect(problems, [&] { fog_liquid_water_g_per_m3(weather); });
  check_range(problems, "rain_rate_mm_per_h", weather.rain_rate_mm_per_h,
              {0.0, kLargestRainRate_mm_per_h, "mm/h"});
  check_range(problems, "polarisation_tilt_rad", weather.polarisation_tilt_rad,
              {-core::kPi, core::kPi, "rad"});
  if (problems.has_errors()) return problems;

  // Values that are right by themselves may still be outside what a law accepts together.
  collect(problems, [&] { fog_layer_dB_per_km(weather, frequency_Hz); });
  collect(problems, [&] { rain_layer_dB_per_km(weather, frequency_Hz); });
  return problems;
}

}  // namespace fanbeam::atmosphere
