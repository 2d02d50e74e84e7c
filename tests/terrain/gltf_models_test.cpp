// Models from elsewhere: the sound ones load whole, none of them does harm.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>

#include "tests/shared_data.h"
#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

namespace fs = std::filesystem;

struct Extent {
  glm::dvec3 least{1e9};
  glm::dvec3 most{-1e9};
};

Extent extent_of(const TriangleMesh& mesh) {
  Extent extent;
  for (const glm::dvec3& v : mesh.vertices_m) {
    for (int axis = 0; axis < 3; ++axis) {
      extent.least[axis] = std::min(extent.least[axis], v[axis]);
      extent.most[axis] = std::max(extent.most[axis], v[axis]);
    }
  }
  return extent;
}

// Of a closed mesh, by the divergence theorem; positive only when the normals point outward.
double volume_m3(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    volume +=
        glm::dot(mesh.vertices_m[t.x], glm::cross(mesh.vertices_m[t.y], mesh.vertices_m[t.z])) /
        6.0;
  return volume;
}

// Triangles as the files list them (index count / 3), counted outside this loader.
TEST_CASE("every sound shared model loads with the triangles of its file", "[gltf]") {
  const auto folder = tests::shared_data("gltf-models/valid");
  if (!folder) return;
  struct Case {
    std::string file;
    std::size_t triangles;
    std::vector<std::string> materials;
  };
  for (const Case& c :
       {Case{"Box_glTF/Box.gltf", 12, {"Red"}}, Case{"Box_glTF-Embedded/Box.gltf", 12, {"Red"}},
        Case{"Box_glTF-Binary/Box.glb", 12, {"Red"}},
        Case{"BoxTextured_glTF/BoxTextured.gltf", 12, {"Texture"}},
        Case{"TwoCubes.glb", 24, {"Material", "Material.001"}}}) {
    INFO(c.file);
    core::ProblemList warnings;
    const TriangleMesh mesh = load_gltf(*folder / c.file, *folder, warnings);
    CHECK(mesh.triangles.size() == c.triangles);
    CHECK(mesh.material_names == c.materials);
    CHECK(warnings.all().empty());
  }
}

TEST_CASE("a sound model that needs a compression is refused by name", "[gltf]") {
  const auto file = tests::shared_data("gltf-models/valid/DenseSphere.glb");
  if (!file) return;
  const auto problems = tests::problems_of(*file, file->parent_path());
  CHECK(tests::has(problems, "E-UNSUPPORTED", "extensionsRequired[1]"));
}

TEST_CASE("T08 the forklift lists every triangle three times and keeps each once", "[gltf]") {
  const auto file = tests::shared_data("gltf-models/valid/forklift_body.glb");
  if (!file) return;
  core::ProblemList warnings;
  const TriangleMesh mesh = load_gltf(*file, file->parent_path(), warnings);
  // The file lists 38 082 triangles, 12 692 of them different; 14 of these have no area.
  CHECK(mesh.triangles.size() == 12'678);
  REQUIRE(warnings.all().size() == 2);
  CHECK(warnings.all().front().code == "W-DEGENERATE");
  // Its material is double-sided, and its surface not closed everywhere: edges counted outside this loader.
  CHECK(warnings.all().back().code == "W-ONE-SIDED");
  CHECK(warnings.all().back().value == "252 edges where open surfaces end");
  CHECK(mesh.material_names == std::vector<std::string>{"lambert15SG"});
}

TEST_CASE("the Box is a cube of 1 m with outward normals", "[gltf]") {
  const auto file = tests::shared_data("gltf-models/valid/Box_glTF-Binary/Box.glb");
  if (!file) return;
  core::ProblemList warnings;
  const TriangleMesh mesh = load_gltf(*file, file->parent_path(), warnings);
  const Extent extent = extent_of(mesh);
  CHECK(glm::length(extent.most - glm::dvec3(0.5)) < 1e-12);
  CHECK(glm::length(extent.least + glm::dvec3(0.5)) < 1e-12);
  CHECK(volume_m3(mesh) == Approx(1.0).epsilon(0.0).margin(1e-12));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3& a = mesh.vertices_m[t.x];
    const glm::dvec3 normal = glm::cross(mesh.vertices_m[t.y] - a, mesh.vertices_m[t.z] - a);
    CHECK(glm::dot(normal, a) == Approx(0.5).epsilon(0.0).margin(1e-12));
  }
}

TEST_CASE("every shared glTF file loads or is refused with reasons", "[gltf]") {
  const auto folder = tests::shared_data("gltf-models");
  if (!folder) return;
  std::size_t loaded = 0;
  std::size_t refused = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(*folder)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
    INFO(file);
    core::ProblemList warnings;
    try {
      const TriangleMesh mesh = load_gltf(file, file.parent_path(), warnings);
      for (const glm::uvec3& t : mesh.triangles)
        REQUIRE(std::max({t.x, t.y, t.z}) < mesh.vertices_m.size());
      ++loaded;
    } catch (const core::InputError& error) {
      CHECK(std::any_of(error.problems().begin(), error.problems().end(),
                        [](const core::Problem& problem) { return problem.is_error(); }));
      for (const core::Problem& problem : error.problems()) CHECK(problem.place.file == file);
      ++refused;
    }
  }
  CHECK(loaded + refused == 198);
  CHECK(loaded > 100);
}

// Not one of these may pass: each would read outside its bytes, loop, or hold no valid container.
TEST_CASE("shared files that break what geometry needs are refused", "[gltf]") {
  const auto folder = tests::shared_data("gltf-models");
  if (!folder) return;
  for (const char* name :
       {"tinygltf/models/BoundsChecking/invalid-primitive-indices.gltf",
        "tinygltf/models/BoundsChecking/integer-out-of-bounds.gltf",
        "validator/base/accessor/small_stride.gltf",
        "validator/base/accessor/unresolved_bufferviews.gltf",
        "validator/base/buffer_view/invalid_length.gltf", "validator/base/glb/chunk_too_big.glb",
        "validator/base/glb/invalid_magic.glb", "validator/base/glb/misplaced_bin_chunk.glb",
        "validator/base/glb/only_bin_chunk.glb", "validator/base/glb/truncated_chunk_data.glb",
        "validator/base/glb/two_valid_json_chunks.glb", "validator/base/glb/zero_length.glb",
        "validator/base/node/node_loop.gltf", "validator/base/node/node_parent_override.gltf"}) {
    const fs::path file = *folder / name;
    INFO(name);
    REQUIRE(fs::exists(file));
    CHECK_FALSE(tests::problems_of(file, file.parent_path()).empty());
  }
}

}  // namespace
}  // namespace fanbeam::terrain
