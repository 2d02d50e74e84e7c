// The outermost layer of a glTF 2.0 file: where its JSON text and its binary chunk lie.
// Source: Khronos Group, glTF 2.0 Specification, version 2.0.1 (2021), section 4, "GLB File Format
// Specification".
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace fanbeam::terrain {

// Views into the bytes that were opened.
struct GltfContainer {
  std::string_view json;
  std::size_t json_offset = 0;  // of `json` in the file
  std::string_view binary;      // the BIN chunk; empty when there is none
  bool is_glb = false;
};

// Bytes that begin with "glTF", and any file named *.glb, are read as GLB, everything else as JSON
// text. Unknown chunks are skipped; a BIN chunk of length zero counts as none.
// Errors: E-PARSE with the byte offset (bad magic, a length that differs from the file's, chunks
// that leave the file, are unaligned, repeated or out of order), E-UNSUPPORTED (GLB version).
GltfContainer open_gltf_container(std::string_view bytes, const std::filesystem::path& file);

// Measures the JSON text without parsing it, so that no parser meets a text that would exhaust its
// stack or memory. Errors: E-LIMIT (kDeepestGltfJson, kMostGltfJsonValues) with the byte offset.
void check_json_size(const GltfContainer& container, const std::filesystem::path& file);

}  // namespace fanbeam::terrain
