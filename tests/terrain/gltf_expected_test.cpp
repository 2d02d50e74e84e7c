// The verdict on every shared model, judged one by one in tests/data/gltf_expected.csv.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "tests/data_rows.h"
#include "tests/peak_memory.h"
#include "tests/processor_time.h"
#include "tests/shared_data.h"
#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  std::set<std::string> errors;    // classes
  std::set<std::string> warnings;  // without W-EMPTY
  bool empty = false;
};

Outcome outcome_of(const fs::path& file) {
  Outcome outcome;
  core::ProblemList warnings;
  try {
    outcome.empty = load_gltf(file, file.parent_path(), warnings).triangles.empty();
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems())
      if (problem.is_error()) outcome.errors.insert(problem.code);
    CHECK_FALSE(outcome.errors.empty());
  }
  for (const core::Problem& problem : warnings.all()) {
    if (problem.code == "W-EMPTY")
      CHECK(outcome.empty);
    else
      outcome.warnings.insert(problem.code);
  }
  return outcome;
}

bool meets(const Outcome& outcome, const std::string& verdict) {
  if (verdict.starts_with("E-")) return outcome.errors.count(verdict) > 0;
  if (!outcome.errors.empty()) return false;
  if (verdict.starts_with("W-")) return outcome.warnings.count(verdict) > 0;
  return outcome.warnings.empty() && verdict == (outcome.empty ? "load-empty" : "load");
}

// Errors that the reference validator found, by path in the shared folder.
std::map<std::string, int> validator_errors(const fs::path& folder) {
  std::map<std::string, int> errors;
  std::ifstream index(folder / "validator/index.csv");
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    const std::size_t comma = line.find(',');
    errors["validator/" + line.substr(0, comma)] = std::stoi(line.substr(comma + 1));
  }
  return errors;
}

TEST_CASE("every shared glTF file meets the verdict of the table", "[gltf]") {
  const auto folder = tests::shared_data("gltf-models");
  if (!folder) return;
  std::set<std::string> judged;
  for (const tests::DataRow& row : tests::data_rows("gltf_expected.csv")) {
    const std::string path = row.text("path");
    INFO(path);
    CHECK(judged.insert(path).second);
    REQUIRE(fs::is_regular_file(*folder / path));
    const Outcome outcome = outcome_of(*folder / path);
    INFO("expected " << row.text("verdict") << ", triangles: " << !outcome.empty);
    for (const std::string& code : outcome.errors) UNSCOPED_INFO(code);
    for (const std::string& code : outcome.warnings) UNSCOPED_INFO(code);
    CHECK(meets(outcome, row.text("verdict")));
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(*folder)) {
    const fs::path extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    INFO(entry.path());
    CHECK(judged.count(entry.path().lexically_relative(*folder).generic_string()) == 1);
  }
}

TEST_CASE("every verdict that differs from the reference validator has its reason", "[gltf]") {
  const auto folder = tests::shared_data("gltf-models");
  if (!folder) return;
  const std::map<std::string, int> errors = validator_errors(*folder);
  REQUIRE(errors.size() == 186);
  std::size_t found = 0;
  for (const tests::DataRow& row : tests::data_rows("gltf_expected.csv")) {
    INFO(row.text("path"));
    const auto reference = errors.find(row.text("path"));
    const bool refused = row.text("verdict").starts_with("E-");
    const bool refused_by_default = reference != errors.end() && reference->second > 0;
    found += reference != errors.end() ? 1 : 0;
    CHECK((refused == refused_by_default || row.has("reason")));
  }
  CHECK(found == errors.size());
}

TEST_CASE("indices need no buffer view: all zero, or sparse", "[gltf]") {
  nlohmann::json document = tests::triangle_document();
  document["meshes"][0]["primitives"][0]["indices"] = 1;
  document["accessors"][1] = {{"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}};
  core::ProblemList warnings;
  CHECK(tests::loaded(document, warnings).triangles.empty());
  CHECK(tests::has(warnings.all(), "W-DEGENERATE"));

  // Zeros but for elements 1 and 2, which become 1 and 2.
  document["buffers"][0]["byteLength"] = 40;
  document["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 2}};
  document["accessors"][1]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 1}}}};
  core::ProblemList none;
  const std::string bytes = tests::triangle_bytes() + std::string("\1\2\0\0", 4);
  CHECK(tests::loaded(document, none, bytes).triangles.size() == 1);
  CHECK(none.all().empty());
}

// A file of 300 bytes made 10 million of them, in seconds and a gigabyte.
TEST_CASE("more than a million elements without a buffer view are E-LIMIT at once", "[gltf]") {
  nlohmann::json document = tests::triangle_document();
  document["accessors"][0].erase("bufferView");
  document["accessors"][0]["count"] = 9'999'999;
  document["meshes"][0]["primitives"][0]["indices"] = 1;
  document["accessors"][1] = {{"componentType", 5125}, {"count", 59'999'997}, {"type", "SCALAR"}};
  const double begin_s = tests::processor_time_s();
  const tests::PeakMemory memory;
  const auto problems = tests::problems_of(document);
  CHECK(tests::has(problems, "E-LIMIT", "meshes[0].primitives[0].attributes.POSITION"));
  CHECK(tests::has(problems, "E-LIMIT", "meshes[0].primitives[0].indices"));
  CHECK(memory.rise_MiB() < 16.0);
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
}

TEST_CASE("a node with a matrix beside a translation is refused", "[gltf]") {
  nlohmann::json document = tests::triangle_document();
  document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  document["nodes"][0]["translation"] = {2, 1, 0};
  CHECK(tests::has(tests::problems_of(document), "E-PARSE", "nodes[0]"));
}

// Section 3.11 of the specification: c / 255, max(c / 127, -1), c / 65535, max(c / 32767, -1).
TEST_CASE("integer positions are read where the file requires the extension", "[gltf]") {
  struct Case {
    int type;
    std::size_t size_bytes;
    double largest;
    std::uint32_t lowest;  // bits of the least value
    double lowest_m;       // as a plain and as a normalised number
    double lowest_normalised;
  };
  for (const Case& c :
       {Case{5120, 1, 127.0, 0x80, -128.0, -1.0}, Case{5121, 1, 255.0, 0, 0.0, 0.0},
        Case{5122, 2, 32767.0, 0x8000, -32768.0, -1.0}, Case{5123, 2, 65535.0, 0, 0.0, 0.0}}) {
    INFO(c.type);
    // (lowest, 1, 0), (1, 0, 0), (0, 0, largest), each padded to four components.
    std::string bytes;
    for (const std::uint32_t value :
         {c.lowest, 1u, 0u, 0u, 1u, 0u, 0u, 0u, 0u, 0u, static_cast<std::uint32_t>(c.largest), 0u})
      bytes += tests::word(value).substr(0, c.size_bytes);
    nlohmann::json document = tests::triangle_document();
    document["extensionsRequired"] = {"KHR_mesh_quantization"};
    document["buffers"][0]["byteLength"] = bytes.size();
    document["bufferViews"][0]["byteLength"] = bytes.size();
    document["bufferViews"][0]["byteStride"] = 4 * c.size_bytes;
    nlohmann::json& accessor = document["accessors"][0];
    accessor["componentType"] = c.type;
    accessor["min"] = {c.lowest_m, 0, 0};  // of the stored numbers, normalised or not
    accessor["max"] = {1, 1, c.largest};
    core::ProblemList warnings;
    const TriangleMesh plain = tests::loaded(document, warnings, bytes);
    REQUIRE(plain.vertices_m.size() == 3);
    CHECK(plain.vertices_m[0].x == -c.lowest_m);  // x right is -x of glTF
    CHECK(plain.vertices_m[2].y == c.largest);
    accessor["normalized"] = true;
    const TriangleMesh normalised = tests::loaded(document, warnings, bytes);
    CHECK(normalised.vertices_m[0].x == -c.lowest_normalised);
    CHECK(normalised.vertices_m[0].z == 1.0 / c.largest);
    CHECK(normalised.vertices_m[2].y == 1.0);
    CHECK(warnings.all().empty());

    document.erase("extensionsRequired");
    const tests::ModelFolder folder;
    folder.write("triangle.bin", bytes);
    CHECK(tests::has(tests::problems_of(folder.write("model.gltf", document.dump()), folder.path()),
                     "E-UNSUPPORTED"));
  }
}

}  // namespace
}  // namespace fanbeam::terrain
