// fanbeam atmosphere: what the air, fog, rain and snow take from a path, and what they echo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common.h"

namespace fanbeam::apps {

struct AtmosphereOptions {
  std::string scene;                  // weather and sensor of a scene; else the options below
  std::string data;                   // as in the other commands
  std::vector<double> frequency_GHz;  // the sensor's when empty
  std::vector<double> compare_GHz;    // two: the choice of frequency as plots
  // The weather, over the scene's where given.
  std::optional<double> rain_mm_per_h, snow_mm_per_h, visibility_m, liquid_water_g_per_m3;
  std::optional<double> temperature_C, humidity, pressure_hPa, fog_top_m;
  std::string rain_law, drop_sizes;  // empty: the scene's or the default
  bool vertical = false;             // polarisation
  double height_m = 100.0, to_height_m = 0.0, range_m = 4000.0, step_m = 500.0;
  bool csv = false, json = false;
  std::string output;  // folder for plot and files
};

int atmosphere(const AtmosphereOptions& options, const CommonOptions& common);

}  // namespace fanbeam::apps
