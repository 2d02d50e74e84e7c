// The library of materials that is shipped.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "core/errors.h"
#include "materials/library/material_library.h"

namespace fanbeam::tests {

inline std::string shipped_library_path() {
  return std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml";
}

inline materials::MaterialLibrary shipped_library() {
  core::ProblemList problems;
  materials::MaterialLibrary library =
      materials::MaterialLibrary::from_file(shipped_library_path(), problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(problems.all().empty());
  return library;
}

}  // namespace fanbeam::tests
