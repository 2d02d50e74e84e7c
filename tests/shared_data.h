// The shared real data (terrain, flights, models) is not part of the project. A test that needs it
// skips where it is absent.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/skipped.h"

namespace fanbeam::tests {

// FANBEAM_DATA, else ../shared/data beside the checkout; `relative` inside it, or nothing when
// absent.
inline std::optional<std::filesystem::path> shared_data(const std::string& relative) {
  const char* from_environment = std::getenv("FANBEAM_DATA");
  const std::filesystem::path root =
      from_environment != nullptr ? std::filesystem::path(from_environment)
                                  : std::filesystem::path(FANBEAM_SOURCE_DIR) / "../shared/data";
  if (std::filesystem::exists(root / relative)) return root / relative;
  skipped("shared data: " + (root / relative).string());
  return std::nullopt;
}

}  // namespace fanbeam::tests
