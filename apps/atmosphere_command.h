// fanbeam atmosphere: what the air, fog, rain and snow take from a path, and what they echo.
#pragma once

#include <string>
#include <vector>

#include "apps/common.h"
#include "apps/weather_options.h"

namespace fanbeam::apps {

struct AtmosphereOptions {
  std::string scene;                  // weather and sensor of a scene; else the options below
  std::string data;                   // as in the other commands
  std::vector<double> frequency_GHz;  // the sensor's when empty
  std::vector<double> compare_GHz;    // two: what the choice of frequency means
  WeatherOptions weather;             // over the scene's
  double height_m = 100.0, to_height_m = 0.0, range_m = 4000.0, step_m = 500.0;
  bool csv = false, json = false;
  std::string output;  // folder for plot and files
};

int atmosphere(const AtmosphereOptions& options, const CommonOptions& common);
CLI::App& add_atmosphere_command(CLI::App& program, AtmosphereOptions& options);

}  // namespace fanbeam::apps
