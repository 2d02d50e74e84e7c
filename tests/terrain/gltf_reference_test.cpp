// References and sizes that lead out of the file.
#include <algorithm>

#include "terrain/gltf/gltf_limits.h"
#include "tests/processor_time.h"
#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

using nlohmann::json;
using tests::has;
using tests::problems_of;
using tests::triangle_document;

constexpr std::uint64_t kMost64 = ~std::uint64_t{0};

// The triangle document with one member changed.
json changed(const std::string& pointer, const json& value) {
  json document = triangle_document();
  document[json::json_pointer(pointer)] = value;
  return document;
}

TEST_CASE("F02 accessors and views beyond their bytes are E-REF", "[gltf]") {
  REQUIRE(problems_of(triangle_document()).empty());
  for (const std::uint64_t count :
       {std::uint64_t{4}, std::uint64_t{1'000'000}, kMost64 / 2, kMost64, std::uint64_t{1} << 62}) {
    INFO("count " << count);
    CHECK(has(problems_of(changed("/accessors/0/count", count)), "E-REF", "accessors[0]"));
  }
  for (const std::uint64_t offset : {std::uint64_t{1}, std::uint64_t{0xFFFFFFFF}, kMost64 - 7}) {
    INFO("byteOffset " << offset);
    CHECK(has(problems_of(changed("/accessors/0/byteOffset", offset)), "E-REF", "accessors[0]"));
    CHECK(
        has(problems_of(changed("/bufferViews/0/byteOffset", offset)), "E-REF", "bufferViews[0]"));
  }
  CHECK(has(problems_of(changed("/bufferViews/0/byteLength", 37)), "E-REF", "bufferViews[0]"));
  CHECK(has(problems_of(changed("/bufferViews/0/byteLength", kMost64)), "E-REF", "bufferViews[0]"));
  CHECK(has(problems_of(changed("/buffers/0/byteLength", 37)), "E-REF", "buffers[0].byteLength"));
}

TEST_CASE("F02 all wrong elements are told together", "[gltf]") {
  json document = changed("/accessors/0/count", 1'000'000);
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 30}, {"byteLength", 7}});
  document["nodes"][0]["scale"] = {1e39, 1, 1};
  const auto problems = problems_of(document);
  CHECK(has(problems, "E-REF", "accessors[0]"));
  CHECK(has(problems, "E-REF", "bufferViews[1]"));
  CHECK(has(problems, "E-NONFINITE", "nodes[0].scale[0]"));
}

TEST_CASE("F02 strides, empty counts and wrong types", "[gltf]") {
  CHECK(has(problems_of(changed("/bufferViews/0/byteStride", 8)), "E-RANGE",
            "bufferViews[0].byteStride"));
  CHECK(has(problems_of(changed("/bufferViews/0/byteStride", 16)), "E-REF", "accessors[0]"));
  CHECK(has(problems_of(changed("/accessors/0/count", 0)), "E-RANGE", "accessors[0].count"));
  CHECK(has(problems_of(changed("/accessors/0/count", -1)), "E-RANGE", "accessors[0].count"));
  CHECK(has(problems_of(changed("/accessors/0/count", 3.5)), "E-PARSE", "accessors[0].count"));
  CHECK(has(problems_of(changed("/accessors/0/count", "3")), "E-PARSE", "accessors[0].count"));
  CHECK(has(problems_of(changed("/accessors/0/componentType", 5124)), "E-PARSE",
            "accessors[0].componentType"));
  CHECK(has(problems_of(changed("/accessors/0/type", "VEC2")), "E-PARSE",
            "meshes[0].primitives[0].attributes.POSITION"));
  CHECK(has(problems_of(changed("/accessors/0/componentType", 5122)), "E-UNSUPPORTED",
            "meshes[0].primitives[0].attributes.POSITION"));
  for (const std::uint64_t mode : {std::uint64_t{7}, (std::uint64_t{1} << 32) + 4})
    CHECK(has(problems_of(changed("/meshes/0/primitives/0/mode", mode)), "E-RANGE",
              "meshes[0].primitives[0].mode"));
}

TEST_CASE("F02 sparse accessors beyond their bytes are E-REF", "[gltf]") {
  const json sparse = json::parse(R"({"count": 1,
    "indices": {"bufferView": 0, "byteOffset": 0, "componentType": 5125},
    "values": {"bufferView": 0, "byteOffset": 0}})");
  REQUIRE(problems_of(changed("/accessors/0/sparse", sparse)).empty());
  json wrong = sparse;
  wrong["indices"]["byteOffset"] = 33;
  CHECK(has(problems_of(changed("/accessors/0/sparse", wrong)), "E-REF",
            "accessors[0].sparse.indices"));
  wrong = sparse;
  wrong["values"]["byteOffset"] = 25;
  CHECK(has(problems_of(changed("/accessors/0/sparse", wrong)), "E-REF",
            "accessors[0].sparse.values"));
  wrong = sparse;
  wrong["count"] = 4;
  CHECK(has(problems_of(changed("/accessors/0/sparse", wrong)), "E-RANGE",
            "accessors[0].sparse.count"));
  wrong = sparse;
  wrong["indices"]["byteOffset"] = 12;  // the bytes of 1.0f
  CHECK(has(problems_of(changed("/accessors/0/sparse", wrong)), "E-REF"));
}

TEST_CASE("F02 a scene larger than the limits is refused before it is read", "[gltf]") {
  json document = triangle_document();
  document["accessors"][0].erase("bufferView");  // legal: all zero
  document["accessors"][0]["count"] = kMostGltfUnbackedElements;
  document["scenes"][0]["nodes"] = json::array();
  for (std::size_t i = 0; i * kMostGltfUnbackedElements <= kMostGltfVertices; ++i) {
    document["nodes"][i]["mesh"] = 0;
    document["scenes"][0]["nodes"].push_back(i);
  }
  CHECK(has(problems_of(document), "E-LIMIT", "scene vertices"));
  document["accessors"][0]["count"] = kMost64;
  CHECK(has(problems_of(document), "E-LIMIT", "meshes[0].primitives[0].attributes.POSITION"));
  CHECK(has(problems_of(changed("/buffers/0/byteLength", kMost64)), "E-LIMIT"));
  document = triangle_document();
  document["buffers"].push_back({{"uri", "a.bin"}, {"byteLength", kLargestGltfBuffers_bytes}});
  CHECK(has(problems_of(document), "E-LIMIT", "buffers[1].byteLength"));
}

TEST_CASE("F03 references to nothing are E-REF with their path", "[gltf]") {
  struct Case {
    std::string pointer;
    json value;
    std::string field;
  };
  const std::vector<Case> cases = {
      {"/meshes/0/primitives/0/attributes/POSITION", 7,
       "meshes[0].primitives[0].attributes.POSITION"},
      {"/meshes/0/primitives/0/indices", 7, "meshes[0].primitives[0].indices"},
      {"/meshes/0/primitives/0/material", 9, "meshes[0].primitives[0].material"},
      {"/nodes/0/children", {99}, "nodes[0].children[0]"},
      {"/nodes/0/mesh", 1, "nodes[0].mesh"},
      {"/scene", 3, "scene"},
      {"/scenes/0/nodes", {0, 5}, "scenes[0].nodes[1]"},
      {"/accessors/0/bufferView", 1, "accessors[0].bufferView"},
      {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer"},
      {"/nodes/0/mesh", -1, "nodes[0].mesh"},
      // 2^32 becomes 0 in a parser that keeps 32 bits.
      {"/nodes/0/mesh", std::uint64_t{1} << 32, "nodes[0].mesh"},
  };
  for (const Case& c : cases) {
    INFO(c.field << " = " << c.value.dump());
    CHECK(has(problems_of(changed(c.pointer, c.value)), "E-REF", c.field));
  }
}

TEST_CASE("F03 an index past the positions is E-REF", "[gltf]") {
  json document = triangle_document();
  document["buffers"][0]["byteLength"] = 48;
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 12}});
  document["accessors"].push_back(
      {{"bufferView", 1}, {"componentType", 5125}, {"count", 3}, {"type", "SCALAR"}});
  document["meshes"][0]["primitives"][0]["indices"] = 1;
  const tests::ModelFolder folder;
  const auto file = folder.write("model.gltf", document.dump());
  for (const std::uint32_t index : {3u, 0xFFFFFFFFu}) {
    folder.write("triangle.bin",
                 tests::triangle_bytes() + tests::word(0) + tests::word(1) + tests::word(index));
    const auto problems = problems_of(file, folder.path());
    REQUIRE(has(problems, "E-REF", "meshes[0].primitives[0].indices element 2"));
    CHECK(problems.at(0).value == std::to_string(index));
  }
}

TEST_CASE("F04 loops, self-children and double parents are E-REF", "[gltf]") {
  const auto with_nodes = [](const char* nodes) {
    json document = triangle_document();
    document["nodes"] = json::parse(nodes);
    return problems_of(document);
  };
  CHECK(has(with_nodes(R"([{"children": [1]}, {"children": [0]}])"), "E-REF"));
  CHECK(has(with_nodes(R"([{"children": [0]}])"), "E-REF", "nodes[0].children[0]"));
  CHECK(has(with_nodes(R"([{"children": [1, 2]}, {"children": [2]}, {}])"), "E-REF",
            "nodes[1].children[0]"));
  CHECK(has(with_nodes(R"([{"children": [1, 1]}, {}])"), "E-REF", "nodes[0].children[1]"));
  // A loop that no scene reaches.
  CHECK(has(with_nodes(R"([{}, {"children": [2]}, {"children": [3]}, {"children": [1]}])"), "E-REF",
            "nodes[1].children"));
  CHECK(has(with_nodes(R"([{}, {"children": [0]}])"), "E-REF", "scenes[0].nodes[0]"));
  CHECK(has(problems_of(changed("/scenes/0/nodes", {0, 0})), "E-REF", "scenes[0].nodes[1]"));
  CHECK(with_nodes(R"([{"children": [1, 2]}, {"mesh": 0}, {"children": [3]}, {}])").empty());
}

// The quicker of two: other programs on the machine slow single runs down.
double chain_time_s(int nodes) {
  json document = triangle_document();
  json chain = json::array();
  for (int i = 0; i + 1 < nodes; ++i)
    chain.push_back({{"children", {i + 1}}, {"translation", {0, 0.25, 0}}});
  chain.push_back({{"mesh", 0}});
  document["nodes"] = std::move(chain);
  double passed_s = 1e9;
  for (int run = 0; run < 2; ++run) {
    core::ProblemList warnings;
    const double begin_s = tests::processor_time_s();
    const TriangleMesh mesh = tests::loaded(document, warnings);
    passed_s = std::min(passed_s, tests::processor_time_s() - begin_s);
    REQUIRE(mesh.triangles.size() == 1);
    CHECK(mesh.vertices_m[0].z == 0.25 * (nodes - 1));
  }
  return passed_s;
}

TEST_CASE("F04 a chain of 100 000 nodes takes as much longer as it has more nodes", "[gltf]") {
  // Ten times the nodes: ten times the time, and a hundred times where every node walks the chain.
  CHECK(chain_time_s(100'000) < 40.0 * chain_time_s(10'000));
}

TEST_CASE("F04 more nodes than the limit are E-LIMIT", "[gltf]") {
  json document = triangle_document();
  document["nodes"] = json(kMostGltfNodes + 1, json::object());
  CHECK(has(problems_of(document), "E-LIMIT", "nodes"));
}

TEST_CASE("extensions that change geometry must be known, others need not", "[gltf]") {
  CHECK(has(problems_of(changed("/extensionsRequired", {"KHR_draco_mesh_compression"})),
            "E-UNSUPPORTED", "extensionsRequired[0]"));
  CHECK(problems_of(changed("/extensionsRequired", {"KHR_materials_unlit"})).empty());
  CHECK(problems_of(changed("/extensionsUsed", {"KHR_draco_mesh_compression"})).empty());
  CHECK(has(problems_of(changed("/asset/version", "3.0")), "E-UNSUPPORTED", "asset.version"));
  CHECK(has(problems_of(changed("/asset/minVersion", "2.1")), "E-UNSUPPORTED"));
  json document = triangle_document();
  document.erase("asset");
  CHECK(has(problems_of(document), "E-PARSE", "asset"));
}

}  // namespace
}  // namespace fanbeam::terrain
