// What frames are remade for when it changes.
#include "session/records/fingerprint.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "session/records/run_record.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

// A sheet of `size` metres: the corners of a triangle.
std::string corners(float size) {
  const float numbers[] = {0, 0, 0, size, 0, 0, 0, size, 0};
  return {reinterpret_cast<const char*>(numbers), sizeof(numbers)};
}

std::string sheet(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
         R"({"attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"count":3,)"
         R"("type":"VEC3","bufferView":0}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("buffers":[{"byteLength":36,"uri":")" +
         uri + "\"}]}";
}

}  // namespace

// They were looked for in the text of models, below their folder alone.
TEST_CASE("A model's buffers are of the input, however and from wherever it names them",
          "[fingerprint]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "models");
  for (const char* uri : {"../m.bin", "..\\/m.bin", "..%2Fm.bin"})
    for (const char* name : {"models/m.gltf", "models/m.GLTF"}) {
      INFO(uri << " in " << name);
      folder.write(name, sheet(uri));
      const auto fingerprint = [&](float size) {
        folder.write("m.bin", corners(size));
        const auto scene = tests::good_scene(
            folder, tests::kSmallScene + "[[model]]\nfile = \"" + name +
                        "\"\nat = { runway = \"36\", behind_threshold_m = 0.0 }\n");
        return session::input_fingerprint(*scene, {});
      };
      const std::string before = fingerprint(1.0F);
      CHECK(fingerprint(2.0F) != before);
      CHECK(fingerprint(1.0F) == before);
    }
}

TEST_CASE("What stands beside a raster is of the input, whatever the case of its ending",
          "[fingerprint]") {
  const TemporaryFolder folder;
  for (const char* name : {"dem.tif", "dem.TIF", "dem.Asc"}) {
    INFO(name);
    const auto raster = folder.write(name, "heights");
    folder.write("dem.tfw", "10");
    const std::string before = session::fingerprint_of("", {raster});
    folder.write("dem.tfw", "20");
    CHECK(session::fingerprint_of("", {raster}) != before);
  }
}

// In a large folder the file system's order told which files were looked at.
TEST_CASE("What stands beside a raster is of the input in a folder of many files",
          "[fingerprint]") {
  const TemporaryFolder folder;
  const auto raster = folder.write("dem.tif", "heights");
  constexpr int kBeside = 40, kOthersEach = 300;
  const auto beside = [](int i) { return "dem." + std::to_string(i); };
  for (int i = 0; i < kBeside; ++i) {
    folder.write(beside(i), "10");
    for (int other = 0; other < kOthersEach; ++other)
      folder.write("other" + std::to_string(i * kOthersEach + other), "");
  }
  std::string before = session::fingerprint_of("", {raster});
  for (int i = 0; i < kBeside; ++i) {
    INFO(i);
    folder.write(beside(i), "20");
    const std::string now = session::fingerprint_of("", {raster});
    CHECK(now != before);
    before = now;
  }
}
