#include "terrain/gltf/gltf_document.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "terrain/gltf/gltf_extensions_private.h"
#include "terrain/gltf/gltf_limits.h"
#include "terrain/gltf/gltf_reducer_private.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;
using nlohmann::json;

// Line and column count from 1; a GLB gets the byte offset only.
core::Place place_of(const GltfContainer& container, const std::string& file, std::size_t offset) {
  core::Place place{file, 0, 0, static_cast<std::int64_t>(container.json_offset + offset)};
  if (container.is_glb) return place;
  const std::string_view before = container.json.substr(0, offset);
  place.line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 on the first line: npos + 1
  place.column = 1 + static_cast<int>(offset - line_start);
  return place;
}

// Without the "[json.exception.parse_error.101] " in front.
std::string words_of(const json::exception& error) {
  const std::string_view text = error.what();
  return std::string(text.substr(text.find(']') + 2));
}

json parsed_json(const GltfContainer& container, const std::string& file) {
  // The parser would take it for the end of the text, whatever stands behind it. Chunks are padded with spaces.
  if (const std::size_t zero = container.json.find('\0'); zero != std::string_view::npos)
    core::throw_input_error(ErrorClass::parse, place_of(container, file, zero), "JSON text",
                            "a zero byte", "well-formed JSON in UTF-8");
  try {
    json root = json::parse(container.json);
    if (root.is_object()) return root;
    core::throw_input_error(ErrorClass::parse, core::Place{file}, "JSON text", shown(root),
                            "an object");
  } catch (const json::parse_error& error) {
    const std::size_t offset = error.byte > 0 ? error.byte - 1 : 0;
    core::throw_input_error(ErrorClass::parse, place_of(container, file, offset), "JSON text",
                            words_of(error), "well-formed JSON in UTF-8");
  } catch (const json::out_of_range& error) {
    core::throw_input_error(ErrorClass::nonfinite, core::Place{file}, "JSON text", words_of(error),
                            "numbers that a double holds");
  }
}

// Positions as integers; the accessors tell which.
bool is_read(const std::string& extension) { return extension == kQuantizationExtension; }

// Extensions that change how a surface looks to the eye and nothing about its shape.
bool concerns_appearance_only(const std::string& extension) {
  constexpr std::string_view kPrefixes[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                            "KHR_lights_"};
  return std::any_of(std::begin(kPrefixes), std::end(kPrefixes),
                     [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

void check_supported(const json& root, const core::Place& place, core::ProblemList& problems) {
  const json& asset = root.at("asset");
  const std::string version = asset.value("version", "");
  if (!version.starts_with("2."))
    problems.error(ErrorClass::unsupported, place, "asset.version", version, "2.x");
  const std::string oldest_reader = asset.value("minVersion", "2.0");
  if (oldest_reader != "2.0")
    problems.error(ErrorClass::unsupported, place, "asset.minVersion", oldest_reader, "2.0");
  const json required = root.value("extensionsRequired", json::array());
  for (std::size_t i = 0; i < required.size(); ++i)
    if (!concerns_appearance_only(required[i]) && !is_read(required[i]))
      problems.error(ErrorClass::unsupported, place,
                     "extensionsRequired[" + std::to_string(i) + "]", required[i],
                     "core glTF 2.0 geometry, or " + std::string(kQuantizationExtension));
  const std::size_t nodes = root.contains("nodes") ? root["nodes"].size() : 0;
  if (nodes > kMostGltfNodes)
    problems.error(ErrorClass::limit, place, "nodes", std::to_string(nodes),
                   "at most " + std::to_string(kMostGltfNodes));
}

// The parser would take the matrix and drop the rest without a word.
void check_transforms(const json& kept, const core::Place& place, core::ProblemList& problems) {
  const auto nodes = kept.find("nodes");
  for (std::size_t i = 0; nodes != kept.end() && i < nodes->size(); ++i) {
    const json& node = (*nodes)[i];
    const bool in_parts =
        node.contains("translation") || node.contains("rotation") || node.contains("scale");
    if (node.contains("matrix") && in_parts)
      problems.error(ErrorClass::parse, place, "nodes[" + std::to_string(i) + "]",
                     "a matrix beside translation, rotation or scale", "one or the other");
  }
}

void hide_indices(json& kept) {
  if (!kept.contains("meshes")) return;
  for (json& mesh : kept["meshes"]) {
    for (json& primitive : mesh["primitives"]) {
      const auto indices = primitive.find("indices");
      if (indices == primitive.end()) continue;
      primitive["attributes"][kIndicesAttribute] = *indices;
      primitive.erase(indices);
    }
  }
}

std::string uri_of(json& object) {
  const auto uri = object.find("uri");
  return uri == object.end() ? std::string() : std::move(uri->get_ref<std::string&>());
}

}  // namespace

GltfDocument read_gltf_document(const GltfContainer& container, const std::filesystem::path& file) {
  const core::Place place{file.string()};
  json root = parsed_json(container, place.file);
  core::ProblemList problems;
  json kept = reduced_gltf(root, place.file, problems);
  problems.throw_if_errors();
  check_supported(kept, place, problems);
  check_transforms(kept, place, problems);

  GltfDocument document;
  document.extension_of_path = taken_extensions(kept);
  for (json& buffer : kept["buffers"]) {
    document.buffers.push_back({uri_of(buffer), buffer["byteLength"]});
    if (document.buffers.back().byte_length == 0)
      problems.error(ErrorClass::range, place,
                     "buffers[" + std::to_string(document.buffers.size() - 1) + "].byteLength", "0",
                     "1 or more");
  }
  for (json& image : kept["images"]) document.image_uris.push_back(uri_of(image));
  problems.throw_if_errors();
  hide_indices(kept);
  kept.erase("buffers");
  kept.erase("images");
  document.json = kept.dump();
  return document;
}

}  // namespace fanbeam::terrain
