// The shared real data (terrain, flights, models) is not part of the project. A test that needs it
// skips with a message where it is absent; with FANBEAM_REQUIRE_DATA=1 that is a failure.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace fanbeam::tests {

// FANBEAM_DATA, else ../shared/data beside the checkout; `relative` inside it, or nothing when
// absent.
inline std::optional<std::filesystem::path> shared_data(const std::string& relative) {
  const char* from_environment = std::getenv("FANBEAM_DATA");
  const std::filesystem::path root =
      from_environment != nullptr ? std::filesystem::path(from_environment)
                                  : std::filesystem::path(FANBEAM_SOURCE_DIR) / "../shared/data";
  if (std::filesystem::exists(root / relative)) return root / relative;
  const char* required = std::getenv("FANBEAM_REQUIRE_DATA");
  if (required != nullptr && std::string(required) == "1")
    FAIL("shared data is required but missing: " << (root / relative).string());
  std::cout << "[skipped] needs shared data: " << relative << '\n';
  return std::nullopt;
}

}  // namespace fanbeam::tests
