// Files that lie about their own size and shape.
#include "terrain/gltf/gltf_container.h"

#include "terrain/gltf/gltf_limits.h"
#include "tests/processor_time.h"
#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

using tests::has;
using tests::problems_of;

std::vector<core::Problem> problems_of_bytes(const std::string& name, const std::string& bytes) {
  const tests::ModelFolder folder;
  return problems_of(folder.write(name, bytes), folder.path());
}

std::string nested(int levels) {
  const auto count = static_cast<std::size_t>(levels);
  return std::string(count, '[') + std::string(count, ']');
}

TEST_CASE("F01 deep nesting is refused before any parser sees it", "[gltf]") {
  std::string text = tests::triangle_document().dump();
  text.back() = ',';
  text += "\"extras\":" + nested(50'000) + "}";
  const double begin_s = tests::processor_time_s();
  const std::vector<core::Problem> problems = problems_of_bytes("deep.gltf", text);
  const double passed_s = tests::processor_time_s() - begin_s;
  CHECK(has(problems, "E-LIMIT", "JSON nesting"));
  CHECK(problems.at(0).place.byte_offset > 0);
  CHECK(passed_s < tests::kAtOnce_s);
}

TEST_CASE("F01 the nesting limit counts brackets outside strings", "[gltf]") {
  const auto check = [](const std::string& text) {
    check_json_size(GltfContainer{text, 0, {}, false}, "x.gltf");
  };
  CHECK_NOTHROW(check(nested(kDeepestGltfJson)));
  CHECK_THROWS_AS(check(nested(kDeepestGltfJson + 1)), core::InputError);
  CHECK_NOTHROW(check("[\"" + std::string(1000, '[') + "\"]"));
  CHECK_NOTHROW(check("[\"\\\"" + std::string(1000, '{') + "\"]"));
  CHECK_THROWS_AS(check("[\"\\\\\"," + nested(1000) + "]"), core::InputError);
}

TEST_CASE("F01 millions of JSON values are refused", "[gltf]") {
  std::string text = "[0";
  for (std::size_t i = 0; i < kMostGltfJsonValues; ++i) text += ",0";
  CHECK(has(problems_of_bytes("wide.gltf", text + "]"), "E-LIMIT", "JSON values"));
}

TEST_CASE("F07 a GLB cut anywhere is E-PARSE", "[gltf]") {
  const std::string whole = tests::triangle_glb();
  const tests::ModelFolder folder;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto problems =
        problems_of(folder.write("cut.glb", whole.substr(0, length)), folder.path());
    INFO("length " << length);
    CHECK(has(problems, "E-PARSE"));
  }
  CHECK(problems_of(folder.write("whole.glb", whole), folder.path()).empty());
}

TEST_CASE("F07 a GLB cut anywhere with its header set right never passes", "[gltf]") {
  const std::string whole = tests::triangle_glb();
  const tests::ModelFolder folder;
  const std::size_t before_binary = whole.size() - 36 - 8;
  for (std::size_t length = 12; length < whole.size(); ++length) {
    std::string cut = whole.substr(0, length);
    cut.replace(8, 4, tests::word(static_cast<std::uint32_t>(length)));
    INFO("length " << length);
    const auto problems = problems_of(folder.write("cut.glb", cut), folder.path());
    // Cut between its chunks the container is whole, and only what it refers to is missing.
    CHECK(has(problems, length == before_binary ? "E-REF" : "E-PARSE"));
  }
}

TEST_CASE("F07 a gltf cut anywhere never passes", "[gltf]") {
  const std::string whole = tests::triangle_document().dump();
  const tests::ModelFolder folder;
  folder.write("triangle.bin", tests::triangle_bytes());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto problems =
        problems_of(folder.write("cut.gltf", whole.substr(0, length)), folder.path());
    CHECK(has(problems, "E-PARSE"));
  }
}

TEST_CASE("F07 lengths that lie are E-PARSE with the byte offset", "[gltf]") {
  struct Case {
    std::size_t offset;
    std::uint32_t value;
  };
  const std::string whole = tests::triangle_glb();
  const auto size = static_cast<std::uint32_t>(whole.size());
  const std::uint32_t most = 0xFFFFFFFF;
  for (const Case& c : {Case{8, size + 1}, Case{8, size - 4}, Case{8, 0}, Case{8, most},
                        Case{12, most}, Case{12, most - 3}, Case{12, 0}, Case{12, 4}}) {
    std::string lying = whole;
    lying.replace(c.offset, 4, tests::word(c.value));
    INFO("word " << c.value << " at " << c.offset);
    CHECK(has(problems_of_bytes("lying.glb", lying), "E-PARSE"));
  }
  const std::size_t binary_header = whole.size() - 36 - 8;
  // The last three are whole words, as a length must be; two of them wrap round in 32 bits.
  for (const std::uint32_t length : {most, most - 3, most - 7, std::uint32_t{36 + 4}}) {
    std::string lying = whole;
    lying.replace(binary_header, 4, tests::word(length));
    INFO("chunk of " << length << " bytes");
    const auto problems = problems_of_bytes("lying.glb", lying);
    REQUIRE(has(problems, "E-PARSE", "GLB chunk length"));
    CHECK(problems.at(0).place.byte_offset == static_cast<std::int64_t>(binary_header));
  }
}

TEST_CASE("F07 unknown chunks are skipped wherever they stand", "[gltf]") {
  nlohmann::json document = tests::triangle_document();
  document["buffers"][0].erase("uri");
  const std::string json = tests::json_chunk(document);
  const std::string binary = tests::binary_chunk(tests::triangle_bytes());
  const std::string unknown = tests::chunk("ABCD", "whatever", ' ');
  CHECK(problems_of_bytes("x.glb", tests::glb(json + binary + unknown + unknown)).empty());
  CHECK(has(problems_of_bytes("x.glb", tests::glb(unknown + json + binary)), "E-PARSE"));
  CHECK(has(problems_of_bytes("x.glb", tests::glb(json + json)), "E-PARSE"));
  CHECK(has(problems_of_bytes("x.glb", tests::glb(json + binary + binary)), "E-PARSE"));
  CHECK(has(problems_of_bytes("x.glb", tests::glb("")), "E-PARSE"));
}

TEST_CASE("F07 a BIN chunk of zero bytes is legal", "[gltf]") {
  const tests::ModelFolder folder;
  folder.write("triangle.bin", tests::triangle_bytes());
  const std::string bytes =
      tests::glb(tests::json_chunk(tests::triangle_document()) + tests::binary_chunk(""));
  core::ProblemList warnings;
  CHECK(load_gltf(folder.write("x.glb", bytes), folder.path(), warnings).triangles.size() == 1);
}

TEST_CASE("F07 GLB of another version is E-UNSUPPORTED", "[gltf]") {
  std::string other = tests::triangle_glb();
  other.replace(4, 4, tests::word(1));
  CHECK(has(problems_of_bytes("x.glb", other), "E-UNSUPPORTED", "GLB version"));
}

TEST_CASE("a syntax error comes with line and column", "[gltf]") {
  const auto problems = problems_of_bytes("x.gltf", "{\n  \"asset\": {\"version\": \"2.0\",}\n}");
  REQUIRE(has(problems, "E-PARSE", "JSON text"));
  CHECK(problems.at(0).place.line == 2);
  CHECK(problems.at(0).place.column == 30);
  CHECK(has(problems_of_bytes("x.gltf", "[1, 2]"), "E-PARSE"));
  CHECK(has(problems_of_bytes("x.gltf", "{\"asset\": 1e999}"), "E-NONFINITE"));
}

// Parsers take it for the end, and what stands behind it for nothing.
TEST_CASE("A zero byte in glTF's JSON is told where it stands", "[gltf]") {
  const auto behind =
      problems_of_bytes("x.gltf", tests::triangle_document().dump() + "\n" + std::string("\0{", 2));
  REQUIRE(has(behind, "E-PARSE", "JSON text"));
  CHECK(behind.at(0).value == "a zero byte");
  CHECK(behind.at(0).place.line == 2);
  CHECK(behind.at(0).place.column == 1);
  nlohmann::json document = tests::triangle_document();
  document["buffers"][0].erase("uri");
  const std::string text = document.dump() + " ";
  const auto padded =
      problems_of_bytes("x.glb", tests::glb(tests::chunk("JSON", text + std::string(4, '\0'), ' ') +
                                            tests::binary_chunk(tests::triangle_bytes())));
  REQUIRE(has(padded, "E-PARSE", "JSON text"));
  CHECK(padded.at(0).place.byte_offset == static_cast<std::int64_t>(20 + text.size()));
}

TEST_CASE("a missing file is E-IO", "[gltf]") {
  CHECK(has(problems_of("no/such/model.glb", "."), "E-IO"));
}

}  // namespace
}  // namespace fanbeam::terrain
