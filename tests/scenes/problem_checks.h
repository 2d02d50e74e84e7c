// Checks of what is told about bad scenes.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

// The scene of this text must not build, for exactly these reasons.
inline void check_problems(const TemporaryFolder& folder, const std::string& text,
                           const std::vector<std::string>& expected) {
  const Outcome outcome = build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  CHECK(messages(folder, outcome.problems) == expected);
}

// One replacement in the small scene, one message.
inline void check_problems(const std::string& from, const std::string& to,
                           const std::string& expected) {
  const TemporaryFolder folder;
  INFO(from << " -> " << to);
  check_problems(folder, replaced(kSmallScene, from, to), {"@/scene.toml:" + expected});
}

inline const std::string kIls = "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0\n";

// The small scene with a recorded flight instead.
inline std::string file_trajectory(const std::string& keys) {
  return replaced(kSmallScene, kIls, "[trajectory]\nfile = \"flight.csv\"\n" + keys);
}

}  // namespace fanbeam::tests
