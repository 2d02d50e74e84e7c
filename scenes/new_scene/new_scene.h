// A scene made from public data: a runway, elevations, perhaps a recorded flight and buildings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/airport/airport.h"
#include "scenes/new_scene/note.h"

namespace fanbeam::scenes {

struct NewSceneRequest {
  std::string name;                // of the scene, a safe word
  std::optional<Airport> airport;  // nothing when reading it failed: the rest is still looked at
  std::string airport_source;      // for comments: "runways.csv"
  std::string runway;              // the end to land on
  std::filesystem::path elevation;
  std::filesystem::path track, buildings;  // empty for none
  // Files inside it are named by their place there and not copied; empty for none.
  std::filesystem::path data_folder;
  double start_distance_m = 5000.0;  // before the threshold, 500 to 20000
  double glide_path_deg = 3.0;
  double threshold_crossing_height_m = 15.0;
};

struct NewSceneFile {
  std::filesystem::path from;
  std::string name;  // inside the scene's folder
};

struct NewScene {
  std::string text;                 // of scene.toml
  std::vector<NewSceneFile> files;  // to be copied beside it
  Notes notes;                      // what was found and guessed
};

// Reads all that is named and decides what the data leave open; writes nothing. Everything wrong is
// added to `problems`: what the readers refuse, an end that the airport does not have, elevation
// data that end before the approach does. Nothing after an error.
std::optional<NewScene> make_new_scene(const NewSceneRequest& request, core::ProblemList& problems);

}  // namespace fanbeam::scenes
