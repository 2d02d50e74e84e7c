// The invented materials of tests/data/open_material: whole, and broken in one place.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "materials/open_material/open_materials.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

inline std::filesystem::path open_material_data() {
  return std::filesystem::path(FANBEAM_SOURCE_DIR) / "tests" / "data" / "open_material";
}

// A copy of the files to break.
class OpenMaterialFolder {
 public:
  OpenMaterialFolder() {
    std::filesystem::copy(open_material_data(), path(), std::filesystem::copy_options::recursive);
  }
  std::filesystem::path path() const { return folder_.path(); }

  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  void replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::ostringstream text;
    text << std::ifstream(path() / name).rdbuf();
    std::string content = text.str();
    const std::size_t at = content.find(from);
    INFO("\"" << from << "\" in " << name);
    REQUIRE(at != std::string::npos);
    write(name, content.replace(at, from.size(), to));
  }

 private:
  TemporaryFolder folder_;
};

struct OpenSurface {
  std::optional<materials::SurfaceModel> surface;
  core::ProblemList problems;
  std::vector<std::filesystem::path> files;
};

inline OpenSurface open_surface(const std::filesystem::path& folder, const std::string& name,
                                const materials::RadarQuery& query = {},
                                const std::string& file = "block.xoma") {
  OpenSurface result;
  materials::OpenMaterials materials(folder / file, folder, query, result.problems);
  if (materials.knows(name))
    if (const auto surface = materials.surface_of(name, result.problems))
      result.surface = surface->reflectivity;
  result.files = materials.files();
  return result;
}

// "block.xomm /materialMapping/0: E-PARSE another row", with the folder taken away.
inline std::vector<std::string> told(const OpenSurface& result) {
  std::vector<std::string> lines;
  for (const core::Problem& problem : result.problems.all()) {
    const std::string file = std::filesystem::path(problem.place.file).filename().string();
    lines.push_back(problem.code + " " + file + " " + problem.field);
    UNSCOPED_INFO(core::to_string(problem));
  }
  return lines;
}

}  // namespace fanbeam::tests
