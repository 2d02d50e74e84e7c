// glTF files made by the tests: whole, and broken in one place.
#pragma once

#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/gltf/gltf_loader.h"

namespace fanbeam::tests {

// Gone with everything in it at the end of the test.
class ModelFolder {
 public:
  ModelFolder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("fanbeam_gltf_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~ModelFolder() { std::filesystem::remove_all(path_); }
  ModelFolder(const ModelFolder&) = delete;
  ModelFolder& operator=(const ModelFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline std::string word(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFF);
  return bytes;
}

inline std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += word(std::bit_cast<std::uint32_t>(value));
  return bytes;
}

// The corners (0,0,0), (1,0,0), (0,1,0) in glTF axes: the normal is +Z, which is forward.
inline std::string triangle_bytes() { return floats({0, 0, 0, 1, 0, 0, 0, 1, 0}); }

// One triangle of `triangle_bytes` in a file beside.
inline nlohmann::json triangle_document() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"uri": "triangle.bin", "byteLength": 36}]})");
}

inline std::string chunk(const std::string& type, std::string bytes, char padding) {
  while (bytes.size() % 4 != 0) bytes += padding;
  return word(static_cast<std::uint32_t>(bytes.size())) + type + bytes;
}

inline std::string glb(const std::string& chunks) {
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

inline std::string json_chunk(const nlohmann::json& document) {
  return chunk("JSON", document.dump(), ' ');
}

inline std::string binary_chunk(const std::string& bytes) {
  return chunk(std::string("BIN\0", 4), bytes, '\0');
}

inline std::string triangle_glb() {
  nlohmann::json document = triangle_document();
  document["buffers"][0].erase("uri");
  return glb(json_chunk(document) + binary_chunk(triangle_bytes()));
}

// The problems of a load that must fail; nothing when it succeeds.
inline std::vector<core::Problem> problems_of(const std::filesystem::path& file,
                                              const std::filesystem::path& allowed_folder) {
  core::ProblemList warnings;
  try {
    terrain::load_gltf(file, allowed_folder, warnings);
  } catch (const core::InputError& error) {
    return error.problems();
  }
  return {};
}

// A document beside a good triangle.bin.
inline std::vector<core::Problem> problems_of(const nlohmann::json& document) {
  const ModelFolder folder;
  folder.write("triangle.bin", triangle_bytes());
  return problems_of(folder.write("model.gltf", document.dump()), folder.path());
}

inline terrain::TriangleMesh loaded(const nlohmann::json& document, core::ProblemList& warnings,
                                    const std::string& bytes = triangle_bytes()) {
  const ModelFolder folder;
  folder.write("triangle.bin", bytes);
  return terrain::load_gltf(folder.write("model.gltf", document.dump()), folder.path(), warnings);
}

inline bool has(const std::vector<core::Problem>& problems, const std::string& code,
                const std::string& field = "") {
  for (const core::Problem& problem : problems)
    if (problem.code == code && (field.empty() || problem.field == field)) return true;
  for (const core::Problem& problem : problems) UNSCOPED_INFO(core::to_string(problem));
  return false;
}

}  // namespace fanbeam::tests
