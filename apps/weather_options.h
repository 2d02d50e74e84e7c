// The weather that options of the command line put over a scene's, or over a standard day.
#pragma once

#include <optional>
#include <string>

#include "atmosphere/weather.h"
#include "core/errors.h"

namespace fanbeam::apps {

// As atmosphere::Weather; what is unset, empty or false stays as it is.
struct WeatherOptions {
  std::optional<double> visibility_m, liquid_water_g_per_m3, fog_top_m;
  std::optional<double> rain_mm_per_h, rain_top_m, melting_height_m, snow_mm_per_h, snow_top_m;
  std::optional<double> temperature_C, humidity, pressure_hPa;
  // Air as P.676 takes it, at the origin.
  std::optional<double> vapour_density_g_per_m3, dry_pressure_hPa;
  bool melting_layer = false;
  std::string fog_type, fog_law, rain_law, rain_echo_law, drop_sizes;
  std::string polarisation;  // "HH" or "VV"
  // Of the rain law: the polarisation's tilt instead of that, and the elevation of the path.
  std::optional<double> tilt_deg, path_elevation_deg;
};

// Throws InputError: E-REF for an unknown name of a law; E-RANGE or E-NONFINITE for air that there
// is not, with the option where it is a vapour density or a dry pressure.
void put_over(const WeatherOptions& options, atmosphere::Weather& weather);

// Of options over `weather`, which has them: E-REF for those about fog, rain or snow where there is
// none of it; E-RANGE for those that its laws of rain do not know.
void check_amounts(const WeatherOptions& options, const atmosphere::Weather& weather,
                   bool rain_cells, core::ProblemList& problems);
void check_laws(const WeatherOptions& options, const atmosphere::Weather& weather,
                core::ProblemList& problems);

// The option that gave a field of atmosphere's problems its value; empty when none did.
std::string option_behind(const WeatherOptions& options, const std::string& field);

}  // namespace fanbeam::apps
