// fanbeam init: a scene of an airport from public data, and what was guessed on the way.
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

struct InitOptions {
  std::string folder, airport, runway;
  // Exactly one of the three says where the runway is; `threshold` needs `far_end`.
  std::string apt_dat, runways, threshold;
  std::string far_end;          // LAT,LON[,HEIGHT_M]
  double runway_width_m = 0.0;  // 0 for an assumed one
  std::string elevation, track, buildings;
  std::string data;  // files in it are named instead of copied
  double start_distance_m = 5000.0, glide_path_deg = 3.0, threshold_crossing_height_m = 15.0;
  bool overwrite = false;
};

// Makes the scene beside its folder, reads and builds it as render would, and only then gives it its
// name; a scene that is there already is kept unless `overwrite`. Prints what was found and guessed.
// Whatever is wrong is printed, all at once, and nothing is written.
int init_scene(const InitOptions& options, const CommonOptions& common);
CLI::App& add_init_command(CLI::App& program, InitOptions& options);

}  // namespace fanbeam::apps
