#include "terrain/gltf/gltf_buffers.h"

#include <utility>

#include "core/relative_uri.h"
#include "terrain/gltf/gltf_data_uri.h"
#include "terrain/gltf/gltf_limits.h"

namespace fanbeam::terrain {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

class BufferLoader {
 public:
  BufferLoader(const GltfContainer& container, const fs::path& file, const fs::path& allowed_folder,
               const FileReader& read_file)
      : container_(container),
        place_{file.string()},
        allowed_folder_(allowed_folder),
        read_file_(read_file) {}

  // Throws InputError E-PATH.
  fs::path resolved(const std::string& uri, const std::string& field) const {
    return core::file_of_uri(allowed_folder_, place_.file, uri, place_, field);
  }

  std::string load(const GltfBufferSource& source, std::size_t i) {
    const std::string field = "buffers[" + std::to_string(i) + "]";
    std::string bytes = bytes_of(source, i, field + ".uri");
    const bool names_data = !source.uri.empty() || !bytes.empty();
    if (names_data && bytes.size() < source.byte_length)
      core::throw_input_error(ErrorClass::ref, place_, field + ".byteLength",
                              std::to_string(source.byte_length),
                              "at most the " + std::to_string(bytes.size()) + " bytes there are");
    if (names_data) bytes.resize(source.byte_length);
    return bytes;
  }

 private:
  std::string bytes_of(const GltfBufferSource& source, std::size_t i, const std::string& field) {
    if (source.uri.empty()) return i == 0 ? std::string(container_.binary) : std::string();
    if (is_data_uri(source.uri)) return data_uri_bytes(source.uri, place_, field);
    std::string bytes = read_file_(resolved(source.uri, field), readable_bytes_);
    readable_bytes_ -= bytes.size();
    return bytes;
  }

  const GltfContainer& container_;
  core::Place place_;
  const fs::path& allowed_folder_;
  const FileReader& read_file_;
  // A large file may stand behind many small buffers and is read for each.
  std::uint64_t readable_bytes_ = kLargestGltfBuffers_bytes;
};

bool total_is_allowed(const GltfDocument& document, const fs::path& file,
                      core::ProblemList& problems) {
  std::uint64_t left_bytes = kLargestGltfBuffers_bytes;
  for (std::size_t i = 0; i < document.buffers.size(); ++i) {
    const std::uint64_t byte_length = document.buffers[i].byte_length;
    if (byte_length > left_bytes) {
      problems.error(ErrorClass::limit, core::Place{file.string()},
                     "buffers[" + std::to_string(i) + "].byteLength", std::to_string(byte_length),
                     "at most " + std::to_string(kLargestGltfBuffers_bytes) +
                         " bytes in all buffers together");
      return false;
    }
    left_bytes -= byte_length;
  }
  return true;
}

}  // namespace

std::vector<std::string> load_gltf_buffers(const GltfDocument& document,
                                           const GltfContainer& container,
                                           const std::filesystem::path& file,
                                           const std::filesystem::path& allowed_folder,
                                           const FileReader& read_file,
                                           core::ProblemList& problems) {
  std::vector<std::string> buffers(document.buffers.size());
  if (!total_is_allowed(document, file, problems)) return buffers;
  BufferLoader loader(container, file, allowed_folder, read_file);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    try {
      buffers[i] = loader.load(document.buffers[i], i);
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  for (std::size_t i = 0; i < document.image_uris.size(); ++i) {
    const std::string& uri = document.image_uris[i];
    if (uri.empty() || is_data_uri(uri)) continue;
    try {
      loader.resolved(uri, "images[" + std::to_string(i) + "].uri");
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  return buffers;
}

}  // namespace fanbeam::terrain
