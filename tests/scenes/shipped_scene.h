// Scenes as they ship.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

inline const std::filesystem::path kShippedScenes =
    std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes";

// That of this folder, which must build.
inline std::unique_ptr<scenes::Scene> shipped_scene(
    const std::string& folder, const std::vector<std::filesystem::path>& data = {}) {
  Outcome outcome = build(kShippedScenes / folder, data);
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  return std::move(outcome.scene);
}

}  // namespace fanbeam::tests
