// Where the triangles of a glTF file end up, and numbers that poison them.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

using nlohmann::json;
using tests::has;
using tests::loaded;
using tests::triangle_document;

glm::dvec3 normal_of(const TriangleMesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles.at(triangle);
  const glm::dvec3& a = mesh.vertices_m.at(t.x);
  return glm::normalize(glm::cross(mesh.vertices_m.at(t.y) - a, mesh.vertices_m.at(t.z) - a));
}

// Positions `bytes`, drawn in `mode` without indices.
json document_of(const std::string& bytes, int mode) {
  json document = triangle_document();
  document["buffers"][0]["byteLength"] = bytes.size();
  document["bufferViews"][0]["byteLength"] = bytes.size();
  document["accessors"][0]["count"] = bytes.size() / 12;
  document["meshes"][0]["primitives"][0]["mode"] = mode;
  return document;
}

TEST_CASE("the glTF frame becomes x right, y forward, z up", "[gltf]") {
  core::ProblemList warnings;
  const TriangleMesh mesh = loaded(triangle_document(), warnings);
  CHECK(warnings.all().empty());
  CHECK(mesh.name == "model");
  REQUIRE(mesh.triangles.size() == 1);
  CHECK(mesh.triangle_material == std::vector<std::uint32_t>{0});
  CHECK(mesh.material_names == std::vector<std::string>{"default"});
  // glTF +X points left of +Z forward, seen with +Y up.
  CHECK(mesh.vertices_m[1] == glm::dvec3(-1, 0, 0));
  CHECK(mesh.vertices_m[2] == glm::dvec3(0, 0, 1));
  CHECK(normal_of(mesh, 0) == glm::dvec3(0, 1, 0));
}

TEST_CASE("nodes apply scale, rotation, translation, then their parents", "[gltf]") {
  json document = triangle_document();
  const double half = std::sqrt(0.5);
  // A quarter turn about glTF +Y takes +X to -Z, that is left to backward.
  document["nodes"] = {{{"children", {1}}, {"translation", {0, 10, 0}}},
                       {{"mesh", 0},
                        {"scale", {2, 3, 4}},
                        {"rotation", {0, half, 0, half}},
                        {"translation", {5, 0, 0}}}};
  core::ProblemList warnings;
  const TriangleMesh mesh = loaded(document, warnings);
  // 1e-15: a few roundings of numbers near 10.
  CHECK(glm::length(mesh.vertices_m[0] - glm::dvec3(-5, 0, 10)) < 1e-14);
  CHECK(glm::length(mesh.vertices_m[1] - glm::dvec3(-5, -2, 10)) < 1e-14);
  CHECK(glm::length(mesh.vertices_m[2] - glm::dvec3(-5, 0, 13)) < 1e-14);

  document["nodes"][1] = {{"mesh", 0},
                          {"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 5, 0, 0, 1}}};
  const TriangleMesh by_matrix = loaded(document, warnings);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(glm::length(mesh.vertices_m[i] - by_matrix.vertices_m[i]) < 1e-14);
}

TEST_CASE("every node that places a mesh is a part with its name", "[gltf]") {
  json document = triangle_document();
  document["nodes"] = {{{"children", {1, 2}}},
                       {{"mesh", 0}, {"name", "cabin"}},
                       {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  core::ProblemList warnings;
  const TriangleMesh mesh = loaded(document, warnings);
  CHECK(mesh.part_names == std::vector<std::string>{"cabin", "node_2"});
  CHECK(mesh.triangle_part == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a double-sided material is told where its surface has a back that shows", "[gltf]") {
  const auto told = [](json document, const std::string& bytes, bool double_sided) {
    document["materials"] = json::array();
    document["materials"][0]["doubleSided"] = double_sided;
    document["meshes"][0]["primitives"][0]["material"] = 0;
    core::ProblemList warnings;
    loaded(document, warnings, bytes);
    std::string texts;
    for (const core::Problem& problem : warnings.all())
      texts += problem.code + " " + problem.value + "; ";
    return texts;
  };
  CHECK(told(triangle_document(), tests::triangle_bytes(), true) ==
        "W-ONE-SIDED 3 edges where open surfaces end; ");
  CHECK(told(triangle_document(), tests::triangle_bytes(), false).empty());
  // A tetrahedron whose faces have corners of their own; without the last one it is open there.
  const std::string a = tests::floats({0, 0, 0}), b = tests::floats({1, 0, 0}),
                    c = tests::floats({0, 1, 0}), d = tests::floats({0, 0, 1});
  const std::string three = a + c + b + a + b + d + b + c + d, all = three + a + d + c;
  CHECK(told(document_of(all, 4), all, true).empty());
  CHECK(told(document_of(three, 4), three, true) ==
        "W-ONE-SIDED 3 edges where open surfaces end; ");
}

TEST_CASE("strips and fans keep every triangle's winding", "[gltf]") {
  // A strip of two squares and a fan around its first corner, all facing glTF +Z.
  const std::string strip = tests::floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
  const std::string fan = tests::floats({0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 2, 0});
  core::ProblemList warnings;
  const TriangleMesh from_strip = loaded(document_of(strip, 5), warnings, strip);
  REQUIRE(from_strip.triangles.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(normal_of(from_strip, i) == glm::dvec3(0, 1, 0));
  const TriangleMesh from_fan = loaded(document_of(fan, 6), warnings, fan);
  REQUIRE(from_fan.triangles.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(normal_of(from_fan, i) == glm::dvec3(0, 1, 0));
  CHECK(warnings.all().empty());
}

TEST_CASE("points and lines are skipped with a warning", "[gltf]") {
  for (const int mode : {0, 1, 2, 3}) {
    core::ProblemList warnings;
    CHECK(loaded(document_of(tests::triangle_bytes(), mode), warnings).triangles.empty());
    CHECK(has(warnings.all(), "W-SKIPPED", "meshes[0].primitives[0]"));
    CHECK(has(warnings.all(), "W-EMPTY"));
  }
}

TEST_CASE("indices of 8, 16 and 32 bits, interleaved and sparse positions", "[gltf]") {
  // Position, eight bytes of something else, three times; then the indices 2 0 1.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string vertices =
      tests::floats({0, 0, 0, nan, nan, 1, 0, 0, nan, nan, 0, 1, 0, nan, nan});
  struct Case {
    int component_type;
    std::string indices;
  };
  for (const Case& c :
       {Case{5121, std::string("\2\0\1", 3)}, Case{5123, std::string("\2\0\0\0\1\0", 6)},
        Case{5125, tests::word(2) + tests::word(0) + tests::word(1)}}) {
    // A replacement for position 1, and its number.
    const std::string bytes =
        vertices + c.indices + tests::floats({7, 0, 0}) + std::string("\1", 1);
    const std::size_t at = 60 + c.indices.size();
    json document = triangle_document();
    document["buffers"][0]["byteLength"] = bytes.size();
    document["bufferViews"] = {
        {{"buffer", 0}, {"byteLength", 60}, {"byteStride", 20}},
        {{"buffer", 0}, {"byteOffset", 60}, {"byteLength", c.indices.size()}},
        {{"buffer", 0}, {"byteOffset", at}, {"byteLength", 13}}};
    document["accessors"].push_back(
        {{"bufferView", 1}, {"componentType", c.component_type}, {"count", 3}, {"type", "SCALAR"}});
    document["meshes"][0]["primitives"][0]["indices"] = 1;
    core::ProblemList warnings;
    TriangleMesh mesh = loaded(document, warnings, bytes);
    REQUIRE(mesh.triangles.size() == 1);
    CHECK(mesh.triangles[0] == glm::uvec3(2, 0, 1));
    CHECK(mesh.vertices_m[1] == glm::dvec3(-1, 0, 0));

    document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", 2}, {"byteOffset", 12}, {"componentType", 5121}}},
        {"values", {{"bufferView", 2}}}};
    mesh = loaded(document, warnings, bytes);
    CHECK(mesh.vertices_m[1] == glm::dvec3(-7, 0, 0));
    CHECK(mesh.vertices_m[2] == glm::dvec3(0, 0, 1));
  }
}

TEST_CASE("materials become slots by name", "[gltf]") {
  json document = triangle_document();
  document["materials"] = {
      {{"name", "paint"}}, json::object(), {{"name", "paint"}}, {{"name", "unused"}}};
  const json primitive = document["meshes"][0]["primitives"][0];
  json& primitives = document["meshes"][0]["primitives"];
  primitives = json::array();
  for (const int material : {2, 1, 0, -1}) {
    primitives.push_back(primitive);
    if (material >= 0) primitives.back()["material"] = material;
  }
  // Four copies at the same place would be duplicates, so each mesh holds one.
  document["nodes"] = json::array();
  document["scenes"][0]["nodes"] = json::array();
  json meshes = json::array();
  for (int i = 0; i < 4; ++i) {
    meshes.push_back({{"primitives", {primitives[static_cast<std::size_t>(i)]}}});
    document["nodes"].push_back({{"mesh", i}, {"translation", {0, 0, i}}});
    document["scenes"][0]["nodes"].push_back(i);
  }
  document["meshes"] = meshes;
  core::ProblemList warnings;
  const TriangleMesh mesh = loaded(document, warnings);
  CHECK(mesh.material_names == std::vector<std::string>{"paint", "material_1", "default"});
  CHECK(mesh.triangle_material == std::vector<std::uint32_t>{0, 1, 0, 2});
}

TEST_CASE("the default scene is the named one, the first, or all roots", "[gltf]") {
  json document = triangle_document();
  document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
  document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  core::ProblemList warnings;
  document["scene"] = 1;
  CHECK(loaded(document, warnings).vertices_m.at(0).y == 5.0);
  document.erase("scene");
  CHECK(loaded(document, warnings).vertices_m.at(0).y == 0.0);
  document.erase("scenes");
  CHECK(loaded(document, warnings).triangles.size() == 2);
}

TEST_CASE("F06 positions that are not numbers are E-NONFINITE with their element", "[gltf]") {
  for (const float poison :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const tests::ModelFolder folder;
    folder.write("triangle.bin", tests::floats({0, 0, 0, 1, 0, 0, 0, poison, 0}));
    const auto file = folder.write("model.gltf", triangle_document().dump());
    CHECK(has(tests::problems_of(file, folder.path()), "E-NONFINITE",
              "meshes[0].primitives[0].attributes.POSITION element 2"));
  }
}

TEST_CASE("F06 transforms beyond a float are E-NONFINITE, beyond the map E-RANGE", "[gltf]") {
  json document = triangle_document();
  document["nodes"][0]["matrix"] = {1e39, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK(has(tests::problems_of(document), "E-NONFINITE", "nodes[0].matrix[0]"));
  document["nodes"][0]["matrix"][0] = 1e30;
  CHECK(has(tests::problems_of(document), "E-RANGE", "mesh 'model' vertex 1.x"));
  document["nodes"][0]["matrix"][0] = 1;
  document["nodes"][0]["matrix"][3] = 0.5;
  CHECK(has(tests::problems_of(document), "E-RANGE", "nodes[0].matrix"));
  // Each factor is a float; their product is not even a double.
  document["nodes"] = json::array();
  for (int i = 0; i < 10; ++i)
    document["nodes"].push_back({{"scale", {1e38, 1e38, 1e38}}, {"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  CHECK(has(tests::problems_of(document), "E-NONFINITE"));
}

TEST_CASE("F06 a scale of zero draws nothing and says so", "[gltf]") {
  for (const json& scale : {json{0, 0, 0}, json{1, 0, 0}}) {
    json document = triangle_document();
    document["nodes"][0]["scale"] = scale;
    core::ProblemList warnings;
    CHECK(loaded(document, warnings).triangles.empty());
    CHECK(has(warnings.all(), "W-DEGENERATE", "nodes[0]"));
  }
}

TEST_CASE("F06 a mirroring scale keeps normals outward", "[gltf]") {
  json document = triangle_document();
  document["nodes"][0]["scale"] = {-1, 1, 1};
  core::ProblemList warnings;
  TriangleMesh mesh = loaded(document, warnings);
  // The side that faced glTF +Z still does; only the triangle lies on the other side.
  CHECK(normal_of(mesh, 0) == glm::dvec3(0, 1, 0));
  CHECK(mesh.vertices_m[1] == glm::dvec3(1, 0, 0));
  document["nodes"][0]["scale"] = {-1, -1, -1};
  mesh = loaded(document, warnings);
  CHECK(normal_of(mesh, 0) == glm::dvec3(0, -1, 0));
  document["nodes"][0]["scale"] = {-1, -1, 1};
  mesh = loaded(document, warnings);
  CHECK(normal_of(mesh, 0) == glm::dvec3(0, 1, 0));
}

TEST_CASE("F06 a rotation of zero length is E-RANGE, a rounded one is normalised", "[gltf]") {
  json document = triangle_document();
  document["nodes"][0]["rotation"] = {0, 0, 0, 0};
  CHECK(has(tests::problems_of(document), "E-RANGE", "nodes[0].rotation"));
  document["nodes"][0]["rotation"] = {0, 0, 0, 0.99};
  core::ProblemList warnings;
  CHECK(loaded(document, warnings).vertices_m[1] == glm::dvec3(-1, 0, 0));
}

TEST_CASE("F06 wrong bounds are ignored with a warning", "[gltf]") {
  json document = triangle_document();
  document["accessors"][0]["min"] = {0, 0, 0};
  document["accessors"][0]["max"] = {1, 1, 0};
  core::ProblemList warnings;
  const TriangleMesh right = loaded(document, warnings);
  CHECK(warnings.all().empty());
  document["accessors"][0]["max"] = {1, 0.99, 0};
  const TriangleMesh wrong = loaded(document, warnings);
  CHECK(has(warnings.all(), "W-BOUNDS", "meshes[0].primitives[0].attributes.POSITION"));
  CHECK(wrong.vertices_m == right.vertices_m);
}

}  // namespace
}  // namespace fanbeam::terrain
