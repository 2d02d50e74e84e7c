// The bytes behind the buffers of a glTF file, and the gate that every URI passes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/gltf/gltf_container.h"
#include "terrain/gltf/gltf_document.h"

namespace fanbeam::terrain {

// Reads a whole file of at most `largest_bytes`; throws core::InputError. core::read_file is one.
using FileReader =
    std::function<std::string(const std::filesystem::path& file, std::uint64_t largest_bytes)>;

// The bytes of every buffer, cut to its byteLength; empty for a buffer that names no data, which is
// an error only where geometry is read from it. URIs are relative to `file` and must end inside
// `allowed_folder`, symbolic links followed; "data:" URIs are decoded. URIs of images pass the same
// gate but are never read.
// Errors into `problems`: E-PATH (another scheme, absolute, outside the folder), E-LIMIT
// (kLargestGltfBuffers_bytes over all buffers, checked before reading), E-REF (fewer bytes than
// byteLength), E-PARSE (a "data:" URI that cannot be decoded), E-IO.
std::vector<std::string> load_gltf_buffers(const GltfDocument& document,
                                           const GltfContainer& container,
                                           const std::filesystem::path& file,
                                           const std::filesystem::path& allowed_folder,
                                           const FileReader& read_file,
                                           core::ProblemList& problems);

}  // namespace fanbeam::terrain
