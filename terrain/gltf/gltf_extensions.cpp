#include <string>
#include <utility>

#include "terrain/gltf/gltf_extensions_private.h"

namespace fanbeam::terrain {
namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

json taken(json& object) {
  const auto found = object.find("extensions");
  if (found == object.end()) return json::object();
  json extensions = std::move(*found);
  object.erase(found);
  return extensions;
}

// Compressed geometry comes as a buffer view of its own.
bool holds_data(const std::string& name, const json& extension) {
  return name == kDraco || (extension.is_object() && extension.contains("bufferView"));
}

bool holds_positions(const json& extension) {
  if (!extension.is_object() || !extension.contains("attributes")) return true;
  const json& attributes = extension["attributes"];
  return !attributes.is_object() || attributes.contains("POSITION");
}

void note_primitive(json& primitive, const std::string& path, GltfExtensionOfPath& of_path) {
  const json extensions = taken(primitive);
  for (const auto& [name, extension] : extensions.items()) {
    if (!holds_data(name, extension)) continue;
    of_path.emplace(path + ".indices", name);
    if (holds_positions(extension)) of_path.emplace(path + ".attributes.POSITION", name);
  }
}

// Of a root array; `any` counts every extension, not only those with a buffer view.
void note_elements(json& kept, const char* array, bool any, GltfExtensionOfPath& of_path) {
  const auto elements = kept.find(array);
  for (std::size_t i = 0; elements != kept.end() && i < elements->size(); ++i) {
    const json extensions = taken((*elements)[i]);
    for (const auto& [name, extension] : extensions.items())
      if (any || holds_data(name, extension))
        of_path.emplace(std::string(array) + "[" + std::to_string(i) + "]", name);
  }
}

}  // namespace

GltfExtensionOfPath taken_extensions(json& kept) {
  GltfExtensionOfPath of_path;
  note_elements(kept, "accessors", false, of_path);
  // Where a buffer without data has an extension, or a view into it, nothing else can fill it.
  note_elements(kept, "bufferViews", true, of_path);
  note_elements(kept, "buffers", true, of_path);
  const auto meshes = kept.find("meshes");
  for (std::size_t i = 0; meshes != kept.end() && i < meshes->size(); ++i) {
    json& primitives = (*meshes)[i]["primitives"];
    for (std::size_t k = 0; k < primitives.size(); ++k)
      note_primitive(primitives[k],
                     "meshes[" + std::to_string(i) + "].primitives[" + std::to_string(k) + "]",
                     of_path);
  }
  return of_path;
}

}  // namespace fanbeam::terrain
