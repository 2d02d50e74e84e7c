// The parsed structure of a glTF file beside its bytes. Private: carries tinygltf's types.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/gltf/gltf_document.h"

namespace fanbeam::terrain {

struct GltfModel {
  std::string file;
  tinygltf::Model parts;  // all but the buffers; references were checked with the document
  std::vector<std::string> buffers;               // empty for one that names no data
  std::vector<std::uint64_t> buffer_sizes_bytes;  // as the file says
  GltfExtensionOfPath extension_of_path;
};

// Errors: E-PARSE with the parser's own words.
GltfModel parse_gltf_model(const GltfDocument& document, std::vector<std::string> buffers,
                           const std::filesystem::path& file);

// Every buffer view against its buffer, every accessor against its views, every primitive against
// what this reader draws. Errors: E-REF (outside the buffer or view), E-RANGE (stride, count,
// mode), E-PARSE (component types and element types that glTF does not have, or not there),
// E-UNSUPPORTED (positions that are neither 32-bit floats nor, where KHR_mesh_quantization is
// required, integers of 8 or 16 bits), E-LIMIT (kMostGltfUnbackedElements).
void check_gltf_accessors(const GltfModel& model, core::ProblemList& problems);

// Whether the elements of a checked accessor are in the file's buffers, or all zero because nothing
// stands behind it. Errors: E-UNSUPPORTED where only an extension has them, which is named; E-REF
// for a buffer without data. `path` is where geometry names the accessor.
bool has_elements(const GltfModel& model, int accessor, const std::string& path,
                  core::ProblemList& problems);

// The elements, which must be there, of a checked accessor of VEC3, normalised where it says so. E-NONFINITE with the
// element,
// E-REF (a sparse index past the end); W-BOUNDS when the file's min and max are not those of the
// elements. `path` goes into the messages.
std::vector<glm::dvec3> read_positions(const GltfModel& model, int accessor,
                                       const std::string& path, core::ProblemList& problems);

// The elements, which must be there, of a checked accessor of unsigned integers, each below `vertex_count`; else E-REF
// with the element.
std::vector<std::uint32_t> read_indices(const GltfModel& model, int accessor,
                                        std::size_t vertex_count, const std::string& path,
                                        core::ProblemList& problems);

}  // namespace fanbeam::terrain
