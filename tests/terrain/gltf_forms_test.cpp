// The same triangle in every form that a glTF file may give it, and data that no buffer holds.
#include <cstdio>

#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

using nlohmann::json;
using tests::has;
using tests::problems_of;
using tests::triangle_document;

constexpr const char* kPosition = "meshes[0].primitives[0].attributes.POSITION";
constexpr const char* kIndices = "meshes[0].primitives[0].indices";

std::size_t triangles_of(const json& document) {
  core::ProblemList warnings;
  return tests::loaded(document, warnings).triangles.size();
}

// Of the first problem in that field; empty when there is none.
std::string value_of(const std::vector<core::Problem>& problems, const std::string& field) {
  for (const core::Problem& problem : problems)
    if (problem.field == field) return problem.value;
  return "";
}

// The triangle with indices, both compressed: as the samples of the extension are written.
json draco_document() {
  json document = triangle_document();
  document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["indices"] = 1;
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes", {{"POSITION", 0}}}};
  document["accessors"][0].erase("bufferView");
  document["accessors"].push_back({{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
  return document;
}

// Every whole number as a number with a fraction.
void write_as_float(json& value) {
  if (value.is_number_integer()) value = value.get<double>();
  if (value.is_structured())
    for (json& element : value) write_as_float(element);
}

TEST_CASE("geometry that only an extension holds is refused by the extension's name", "[gltf]") {
  json document = draco_document();
  const auto problems = problems_of(document);
  REQUIRE(has(problems, "E-UNSUPPORTED", kPosition));
  CHECK(has(problems, "E-UNSUPPORTED", kIndices));
  for (const char* field : {kPosition, kIndices})
    CHECK(value_of(problems, field) == "data that only KHR_draco_mesh_compression holds");

  // Beyond what may be zeros without a buffer view, still for the reason that helps.
  document["accessors"][0]["count"] = 2'000'000;
  CHECK(has(problems_of(document), "E-UNSUPPORTED", kPosition));

  // The uncompressed copy that a reader without the extension is meant to take.
  document = draco_document();
  document["accessors"][0]["bufferView"] = 0;
  document["meshes"][0]["primitives"][0].erase("indices");
  CHECK(triangles_of(document) == 1);

  // A mesh that no node places needs no data.
  document = draco_document();
  document["nodes"][0].erase("mesh");
  CHECK(triangles_of(document) == 0);
  CHECK(problems_of(document).empty());
}

TEST_CASE("zeros stay valid beside extensions that hold no data", "[gltf]") {
  json document = draco_document();
  json& extensions = document["meshes"][0]["primitives"][0]["extensions"];
  extensions = {{"KHR_materials_variants", {{"mappings", json::array()}}}, {"EXT_other", 5}};
  CHECK(problems_of(document).empty());
  // Compressed texture coordinates leave positions to the core specification.
  extensions = {
      {"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"TEXCOORD_0", 0}}}}}};
  document["meshes"][0]["primitives"][0].erase("indices");
  CHECK(problems_of(document).empty());
  extensions = 5;
  CHECK(has(problems_of(document), "E-PARSE", "meshes[0].primitives[0].extensions"));
}

TEST_CASE("a view that an extension fills is refused by name where its buffer is empty", "[gltf]") {
  json document = triangle_document();
  document["extensionsUsed"] = {"EXT_meshopt_compression"};
  document["buffers"].push_back({{"byteLength", 36}});
  document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0}, {"byteLength", 20}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
  CHECK(triangles_of(document) == 1);  // the fallback has data
  document["bufferViews"][0]["buffer"] = 1;
  const auto problems = problems_of(document);
  REQUIRE(has(problems, "E-UNSUPPORTED", "bufferViews[0]"));
  CHECK(problems.at(0).value == "data that only EXT_meshopt_compression holds");

  document["bufferViews"][0].erase("extensions");
  document["buffers"][1]["extensions"]["EXT_meshopt_compression"] = {{"fallback", true}};
  CHECK(has(problems_of(document), "E-UNSUPPORTED", "buffers[1]"));
  document["buffers"][1].erase("extensions");
  document["accessors"][0]["extensions"]["EXT_stream"] = {{"bufferView", 0}};
  CHECK(value_of(problems_of(document), kPosition) == "data that only EXT_stream holds");
}

TEST_CASE("a buffer without a URI is sound until geometry is read from it", "[gltf]") {
  json document = triangle_document();
  document["buffers"].push_back({{"byteLength", 100}});
  document["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 64}, {"byteLength", 36}});
  document["accessors"].push_back(document["accessors"][0]);
  document["accessors"][1]["bufferView"] = 1;
  document["meshes"].push_back(document["meshes"][0]);
  document["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 1;
  CHECK(triangles_of(document) == 1);
  document["bufferViews"][1]["byteOffset"] = 65;  // its size binds all the same
  CHECK(has(problems_of(document), "E-REF", "bufferViews[1]"));
  document["bufferViews"][1]["byteOffset"] = 64;

  document["nodes"][0]["mesh"] = 1;
  CHECK(has(problems_of(document), "E-REF", "buffers[1].uri"));
  // Sparse values come from a buffer too.
  document["accessors"][1] = document["accessors"][0];
  document["accessors"][1]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 0}}}};
  CHECK(has(problems_of(document), "E-REF", "buffers[1].uri"));
}

TEST_CASE("whole numbers may be written with a fraction of zero", "[gltf]") {
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["mode"] = 4;
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::parse(R"([{"name": "steel"}])");
  document["accessors"][0]["byteOffset"] = 0;
  document["bufferViews"][0]["byteStride"] = 12;
  core::ProblemList none;
  const TriangleMesh whole = tests::loaded(document, none);
  write_as_float(document);
  REQUIRE(document["buffers"][0]["byteLength"].dump() == "36.0");
  const TriangleMesh written_as_float = tests::loaded(document, none);
  CHECK(none.all().empty());
  CHECK(written_as_float.vertices_m == whole.vertices_m);
  CHECK(written_as_float.triangles == whole.triangles);
  CHECK(written_as_float.material_names == whole.material_names);

  for (const double wrong : {36.5, 1e300, 2e16}) {
    document["buffers"][0]["byteLength"] = wrong;
    CHECK(has(problems_of(document), "E-PARSE", "buffers[0].byteLength"));
  }
  document["buffers"][0]["byteLength"] = -36.0;
  CHECK(has(problems_of(document), "E-RANGE", "buffers[0].byteLength"));
  document["nodes"][0]["mesh"] = 1.0;
  CHECK(has(problems_of(document), "E-REF", "nodes[0].mesh"));
}

TEST_CASE("a member that is not there is told with those that are", "[gltf]") {
  json document = triangle_document();
  document["accessors"][0].erase("componentType");
  document["accessors"][0]["componenttype"] = 5126;
  const auto problems = problems_of(document);
  REQUIRE(has(problems, "E-PARSE", "accessors[0].componentType"));
  CHECK(problems.at(0).expected ==
        "it to be there; perhaps componenttype of bufferView, componenttype, count, type");
}

TEST_CASE("data URIs carry plain, percent-encoded and base64 bytes of any type", "[gltf]") {
  std::string percent, mixed;
  for (const char byte : tests::triangle_bytes()) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%%%02x", static_cast<unsigned char>(byte));
    percent += digits;
    mixed += byte == '?' ? "?" : digits;  // 0x3f stands for itself
  }
  // Twelve zero bytes, then 1.0f, 8 zero bytes, 4 zero bytes, 1.0f, 4 zero bytes.
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  json document = triangle_document();
  for (const std::string& uri :
       {"data:," + percent, "data:," + mixed, "data:application/octet-stream," + percent,
        "data:text/plain;charset=latin1," + percent, "DATA:;p=%2C;q," + percent,
        "data:;base64," + base64, "data:;BASE64," + base64, "data:a/b;p=1;base64," + base64,
        "data:;base64," + base64 + "AA%3D%3D", "data:;base64," + base64 + "AA",
        "data:;base64,%41" + base64.substr(1)}) {
    INFO(uri);
    document["buffers"][0]["uri"] = uri;
    CHECK(triangles_of(document) == 1);
  }
}

}  // namespace
}  // namespace fanbeam::terrain
