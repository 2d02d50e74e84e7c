// Which scene a command works on: what the commands that load one ask for in the same words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/description.h"
#include "session/render_request.h"

namespace CLI {
class App;
}

namespace fanbeam::apps {

using session::SceneChoice;

// SCENE, --sensor and --data.
void add_scene_choice(CLI::App& command, SceneChoice& choice);

// What is wrong with the scene is in `problems`. Throws InputError E-IO for all of scene, sensor
// and data folder that are not there, and as shipped_folder.
scenes::SceneDescription read_chosen_scene(const SceneChoice& choice, core::ProblemList& problems);

// What a chosen scene is read from: scene.toml and what it is made of, files of models and buildings once they
// are read.
std::vector<std::filesystem::path> files_of_scene(const SceneChoice& choice,
                                                  const scenes::SceneDescription& scene);

}  // namespace fanbeam::apps
