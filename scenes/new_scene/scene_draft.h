// Everything that a new scene's file will say, decided; and the text that says it.
#pragma once

#include <optional>
#include <string>

#include "core/geodetic.h"
#include "scenes/airport/airport.h"
#include "scenes/new_scene/buildings_guess.h"
#include "scenes/new_scene/track_guess.h"

namespace fanbeam::scenes {

struct SceneDraft {
  std::string name, title, source;
  core::Geodetic origin;  // the threshold, its height in `datum`
  core::VerticalDatum datum = core::VerticalDatum::egm96;
  std::string datum_why;

  double west_m = 0.0, east_m = 0.0, south_m = 0.0, north_m = 0.0;  // of the terrain, all positive
  double spacing_m = 10.0;
  std::string elevation;
  bool fill_voids = false;
  double quantisation_step_m = 0.0;

  Landing landing;
  double width_m = 45.0;
  double end_height_m[2] = {0.0, 0.0};  // of landing.runway.ends, in `datum`
  bool end_height_known[2] = {true, true};

  std::string buildings_file;  // empty for none
  BuildingsGuess buildings;

  std::string track_file;  // empty for an instrument approach
  TrackGuess track;
  double start_distance_m = 5000.0, glide_path_deg = 3.0, threshold_crossing_height_m = 15.0;
};

// A scene.toml with a comment for each key.
std::string scene_text(const SceneDraft& draft);

}  // namespace fanbeam::scenes
