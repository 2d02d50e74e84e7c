#include "apps/scene_choice.h"

#include <CLI/CLI.hpp>

#include "apps/common.h"
#include "scenes/scene_reader.h"

namespace fanbeam::apps {

void add_scene_choice(CLI::App& command, SceneChoice& choice) {
  command
      .add_option("SCENE", choice.scene,
                  "A folder with scene.toml, that file, or the name of a shipped scene")
      ->capture_default_str();
  command.add_option("--sensor", choice.sensor, "Sensor file instead of the scene's");
  command.add_option("--data", choice.data,
                     "Folder with terrain and flight data (before FANBEAM_DATA)");
}

scenes::SceneDescription read_chosen_scene(const SceneChoice& choice, core::ProblemList& problems) {
  const scenes::SceneOptions options{shipped_folder(), data_folders(choice.data), choice.sensor};
  return scenes::read_scene(find_scene(choice.scene), options, problems);
}

}  // namespace fanbeam::apps
