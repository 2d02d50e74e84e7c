// The JSON text of a glTF file, brought down to what geometry needs and with every type and every
// reference checked.
//
// The glTF parser behind it takes wrong types for missing ones, cuts 64-bit numbers to 32 bits and
// opens files by itself. It therefore gets a text that holds only known members of known types
// whose references exist, and neither buffers nor images.
// Source of members, types and defaults: Khronos Group, glTF 2.0 Specification, version 2.0.1
// (2021), section 5, "Properties Reference".
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/gltf/gltf_container.h"

namespace fanbeam::terrain {

// The one extension to geometry that is read.
inline constexpr const char* kQuantizationExtension = "KHR_mesh_quantization";

struct GltfBufferSource {
  std::string uri;  // empty: the BIN chunk, or no data at all
  std::uint64_t byte_length = 0;
};

// The parser behind refuses indices that need no buffer view (all zero, or sparse), but attributes
// may do without one.
inline constexpr const char* kIndicesAttribute = "_INDICES";

// The extension that may hold the data of a part of the file, by the part's path:
// "meshes[0].primitives[1].attributes.POSITION", "accessors[2]", "bufferViews[3]", "buffers[0]".
using GltfExtensionOfPath = std::map<std::string, std::string>;

struct GltfDocument {
  std::string json;  // asset, scenes, nodes, meshes, materials, accessors and buffer views
                     // with the indices of a primitive as its attribute kIndicesAttribute
  std::vector<GltfBufferSource> buffers;
  std::vector<std::string> image_uris;  // by image, empty for an image in a buffer
  GltfExtensionOfPath extension_of_path;
};

// Whole numbers may be written as 36.0 or 3.6e1: to JSON that is the number 36, and there are
// writers that know no other. Extensions are not read, but noted where data may hide in them.
// Errors, all together: E-PARSE (not JSON, with line, column and byte offset; a member missing or
// of another type; a node with a matrix beside translation, rotation or scale), E-NONFINITE (a
// number beyond double), E-RANGE (a negative size, an empty buffer), E-REF (an index of something
// that is not there), E-LIMIT (kMostGltfNodes).
GltfDocument read_gltf_document(const GltfContainer& container, const std::filesystem::path& file);

}  // namespace fanbeam::terrain
