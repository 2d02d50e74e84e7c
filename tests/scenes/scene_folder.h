// Small scenes of a test's own: written to a folder, read, built, and everything reported about
// them.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

// A runway on a plain, a hangar beside it, fog, an approach from the south.
inline const std::string kSmallScene = R"([scene]
name = "test"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 50.0 }
vertical_datum = "scene"

[terrain]
half_extent_m = 2500.0
spacing_m = 50.0
material = "short_grass"

[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 50.0 }
second = { name = "18", latitude_deg = 52.009, longitude_deg = 10.0, elevation_m = 60.0 }

[[box]]
name = "hangar"
at = { runway = "36", behind_threshold_m = 300.0, left_m = 200.0 }
length_m = 40.0
width_m = 30.0
height_m = 12.0

[weather]
visibility_m = 400.0

[trajectory.ils]
runway = "36"
start_distance_m = 1500.0
)";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("\"" << from << "\" in the scene");
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Outcome {
  std::unique_ptr<scenes::Scene> scene;  // nothing when there were errors
  std::vector<core::Problem> problems;
};

inline Outcome build(const std::filesystem::path& scene,
                     std::vector<std::filesystem::path> data_folders = {}) {
  Outcome outcome;
  core::ProblemList problems;
  const scenes::SceneOptions options{FANBEAM_SOURCE_DIR, std::move(data_folders), {}};
  const scenes::SceneDescription description = scenes::read_scene(scene, options, problems);
  try {
    outcome.scene = scenes::build_scene(description, {}, problems);
  } catch (const core::InputError& error) {
    outcome.problems = error.problems();
    return outcome;
  }
  outcome.problems = problems.all();
  return outcome;
}

inline Outcome build_text(const TemporaryFolder& folder, const std::string& text) {
  folder.write("scene.toml", text);
  return build(folder.path());
}

// The scene of a text that must be free of errors.
inline std::unique_ptr<scenes::Scene> good_scene(const TemporaryFolder& folder,
                                                 const std::string& text) {
  Outcome outcome = build_text(folder, text);
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  return std::move(outcome.scene);
}

// The printed problems by line, with "@" for the scene's folder and "#" for that of the shipped
// files.
inline std::vector<std::string> messages(const TemporaryFolder& folder,
                                         std::vector<core::Problem> problems) {
  std::stable_sort(
      problems.begin(), problems.end(),
      [](const core::Problem& a, const core::Problem& b) { return a.place.line < b.place.line; });
  std::vector<std::string> texts;
  for (const core::Problem& problem : problems) {
    std::string text = core::to_string(problem);
    for (const auto& [path, sign] :
         {std::pair<std::string, std::string>{folder.path().string(), "@"},
          {std::string(FANBEAM_SOURCE_DIR), "#"}})
      for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path))
        text.replace(at, path.size(), sign);
    texts.push_back(text);
  }
  return texts;
}

}  // namespace fanbeam::tests
