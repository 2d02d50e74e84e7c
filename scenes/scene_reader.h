// Reads scene.toml into a SceneDescription.
#pragma once

#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "scenes/description.h"

namespace fanbeam::scenes {

// Where shipped files lie and what the command line overrides.
struct SceneOptions {
  std::filesystem::path shipped;  // holds scenes/, sensors/ and materials/
  std::vector<std::filesystem::path> data_folders;
  std::filesystem::path sensor;  // replaces the scene's sensor file; empty to keep it
};

// `scene` is a folder with scene.toml, or that file. All problems of the scene and its sensor file
// go to `problems`; when it holds errors the description must not be built.
SceneDescription read_scene(const std::filesystem::path& scene, const SceneOptions& options,
                            core::ProblemList& problems);

}  // namespace fanbeam::scenes
