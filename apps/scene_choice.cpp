#include "apps/scene_choice.h"

#include <CLI/CLI.hpp>
#include <system_error>

#include "apps/command_line.h"
#include "apps/value_words.h"
#include "scenes/scene_reader.h"
#include "session/records/fingerprint.h"
#include "session/shipped.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

// What `find` gives; what it throws goes to `problems`.
template <class Find>
auto tried(const Find& find, core::ProblemList& problems) -> decltype(find()) {
  try {
    return find();
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return {};
  }
}

}  // namespace

void add_scene_choice(CLI::App& command, SceneChoice& choice) {
  command
      .add_option("SCENE", choice.scene,
                  "A folder with scene.toml, that file, or the name of a shipped scene (fanbeam "
                  "list scenes)")
      ->type_name(kSceneValue)
      ->capture_default_str();
  command
      .add_option("--sensor", choice.sensor,
                  "Sensor file, or the name of a shipped sensor (fanbeam list sensors), instead of "
                  "the scene's")
      ->type_name(kSensorValue);
  add_data_option(command, choice.data, kDataOrder);
}

scenes::SceneDescription read_chosen_scene(const SceneChoice& choice, core::ProblemList& problems) {
  core::ProblemList missing;
  const fs::path scene =
      tried([&] { return session::find_scene(choice.scene, shipped_folder()); }, missing);
  const fs::path sensor =
      choice.sensor.empty()
          ? fs::path()
          : tried([&] { return session::find_sensor(choice.sensor, shipped_folder(), "--sensor"); },
                  missing);
  const std::vector<fs::path> data = tried([&] { return data_folders(choice.data); }, missing);
  missing.throw_if_errors();
  return scenes::read_scene(scene, {shipped_folder(), data, sensor}, problems);
}

std::vector<fs::path> files_of_scene(const SceneChoice& choice,
                                     const scenes::SceneDescription& scene) {
  std::vector<fs::path> files = session::with_companions(scene.files);
  const fs::path chosen = session::find_scene(choice.scene, shipped_folder());
  std::error_code status;
  files.push_back(fs::is_directory(chosen, status) ? chosen / "scene.toml" : chosen);
  return files;
}

}  // namespace fanbeam::apps
