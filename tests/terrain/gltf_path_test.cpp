// Files that a glTF file names, and which of them are opened.
#include "core/files.h"
#include "tests/peak_memory.h"
#include "tests/terrain/gltf_test_files.h"

namespace fanbeam::terrain {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tests::has;

// Loads and writes down every file that was opened.
struct Load {
  std::vector<fs::path> opened;
  std::vector<core::Problem> problems;
  std::size_t triangles = 0;

  Load(const fs::path& file, const fs::path& allowed_folder) {
    core::ProblemList warnings;
    const FileReader read = [this](const fs::path& path, std::uint64_t largest_bytes) {
      opened.push_back(fs::weakly_canonical(path));
      return core::read_file(path, largest_bytes);
    };
    try {
      triangles = load_gltf(file, allowed_folder, warnings, read).triangles.size();
    } catch (const core::InputError& error) {
      problems = error.problems();
    }
  }
};

TEST_CASE("F05 no file outside the folder is opened for a buffer or an image", "[gltf]") {
  const tests::ModelFolder outside;
  const fs::path secret = outside.write("secret.bin", tests::triangle_bytes());
  const tests::ModelFolder inside;
  inside.write("triangle.bin", tests::triangle_bytes());
  fs::create_symlink(secret, inside.path() / "link.bin");
  fs::create_directory_symlink(outside.path(), inside.path() / "folder");

  const std::string up = "../" + outside.path().filename().string() + "/secret.bin";
  for (const std::string& uri :
       {std::string("../../../../etc/hostname"), std::string("/etc/hostname"), secret.string(), up,
        "sub/../" + up, "%2e%2e/" + up.substr(3), "..%2F" + up.substr(3), std::string("link.bin"),
        std::string("folder/secret.bin"), "file://" + secret.string(), "FILE:" + secret.string(),
        std::string("http://example.com/a.bin"), std::string("//example.com/a.bin"),
        std::string("triangle.bin%00.png")}) {
    INFO(uri);
    json document = tests::triangle_document();
    document["buffers"][0]["uri"] = uri;
    const fs::path file = inside.write("model.gltf", document.dump());
    const Load buffer(file, inside.path());
    CHECK(has(buffer.problems, "E-PATH", "buffers[0].uri"));
    CHECK(buffer.opened == std::vector<fs::path>{fs::canonical(file)});

    document = tests::triangle_document();
    document["images"] = json::array({{{"uri", uri}}});
    inside.write("model.gltf", document.dump());
    const Load image(file, inside.path());
    CHECK(has(image.problems, "E-PATH", "images[0].uri"));
    CHECK(image.opened.size() == 2);
  }
}

TEST_CASE("F05 files inside the allowed folder are found from the file's own folder", "[gltf]") {
  const tests::ModelFolder folder;
  folder.write("shared data/triangle.bin", tests::triangle_bytes());
  fs::create_symlink(folder.path() / "shared data" / "triangle.bin", folder.path() / "link.bin");
  json document = tests::triangle_document();
  for (const char* uri : {"../shared%20data/triangle.bin", "../shared data/triangle.bin",
                          "../link.bin", "./../models/../link.bin"}) {
    INFO(uri);
    document["buffers"][0]["uri"] = uri;
    const fs::path file = folder.write("models/model.gltf", document.dump());
    CHECK(Load(file, folder.path()).triangles == 1);
    CHECK(has(Load(file, file.parent_path()).problems, "E-PATH"));
  }
  const fs::path file = folder.path() / "models" / "model.gltf";
  document["buffers"][0]["uri"] = "missing.bin";
  folder.write("models/model.gltf", document.dump());
  CHECK(has(Load(file, folder.path()).problems, "E-IO"));
  document["buffers"][0]["uri"] = "../shared data";
  folder.write("models/model.gltf", document.dump());
  CHECK(has(Load(file, folder.path()).problems, "E-IO"));
}

TEST_CASE("F05 data URIs in base64 need no file", "[gltf]") {
  const tests::ModelFolder folder;
  json document = tests::triangle_document();
  // Twelve zero bytes, then 1.0f, 8 zero bytes, 4 zero bytes, 1.0f, 4 zero bytes.
  const std::string payload = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  for (const char* type : {"", "application/octet-stream", "application/gltf-buffer", "x/y;p=1"}) {
    document["buffers"][0]["uri"] = std::string("data:") + type + ";base64," + payload;
    const Load load(folder.write("model.gltf", document.dump()), folder.path());
    CHECK(load.triangles == 1);
    CHECK(load.opened.size() == 1);
  }
  const auto problems = [&](const std::string& uri) {
    document["buffers"][0]["uri"] = uri;
    return tests::problems_of(document);
  };
  CHECK(has(problems("data:;base64,AAAA"), "E-REF", "buffers[0].byteLength"));
  CHECK(has(problems("data:;base64,####"), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:;base64," + payload.substr(0, 47) + "!"), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:;base64," + payload.substr(0, 45)), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:;base64," + payload + "==="), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:,AAAA"), "E-REF", "buffers[0].byteLength"));
  CHECK(has(problems("data:,%0"), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:,%0x00"), "E-PARSE", "buffers[0].uri"));
  CHECK(has(problems("data:"), "E-PARSE", "buffers[0].uri"));
}

TEST_CASE("F08 an image bomb is neither opened nor decoded", "[gltf]") {
  // A PNG header that claims 65535 x 65535 pixels, and nothing behind it.
  const std::string bomb =
      std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xff\xff\0\0\xff\xff\x10\x02\0\0\0", 29);
  const tests::ModelFolder folder;
  const fs::path bomb_file = folder.write("bomb.png", bomb);
  json document = tests::triangle_document();
  document["buffers"][0].erase("uri");
  document["buffers"][0]["byteLength"] = 36 + bomb.size();
  document["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", bomb.size()}});
  document["images"] = json::parse(R"([{"uri": "bomb.png"}, {"uri": "missing.png"},
    {"bufferView": 1, "mimeType": "image/png"}, {"uri": "data:image/png;base64,iVBORw0KGgo="}])");
  document["textures"] = json::parse(R"([{"source": 0}, {"source": 2}])");
  document["materials"] =
      json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  document["meshes"][0]["primitives"][0]["material"] = 0;
  const fs::path file =
      folder.write("model.glb", tests::glb(tests::json_chunk(document) +
                                           tests::binary_chunk(tests::triangle_bytes() + bomb)));
  const tests::PeakMemory memory;
  const Load load(file, folder.path());
  CHECK(load.problems.empty());
  CHECK(load.triangles == 1);
  CHECK(load.opened == std::vector<fs::path>{fs::canonical(file)});
  CHECK(memory.rise_MiB() < 64.0);
}

}  // namespace
}  // namespace fanbeam::terrain
