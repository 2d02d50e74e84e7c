// A test that something is missing for skips with a message, which ./dev test counts; with
// FANBEAM_REQUIRE_DATA=1 that is a failure.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <string>

namespace fanbeam::tests {

inline void skipped(const std::string& need) {
  const char* required = std::getenv("FANBEAM_REQUIRE_DATA");
  if (required != nullptr && std::string(required) == "1") FAIL("required but missing: " << need);
  std::cout << "[skipped] needs " << need << '\n';
}

}  // namespace fanbeam::tests
