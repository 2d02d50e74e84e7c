#include "terrain/gltf/gltf_buffers.h"

#include <tiny_gltf.h>

#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/files.h"
#include "terrain/gltf/gltf_limits.h"

namespace fanbeam::terrain {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

constexpr std::string_view kDataScheme = "data:";
constexpr std::string_view kBase64Mark = ";base64,";

// RFC 3986, section 2.1: "%2e" is a point. Anything else stays as it is.
std::string percent_decoded(const std::string& uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded += static_cast<char>(byte);
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

class BufferLoader {
 public:
  BufferLoader(const GltfContainer& container, const fs::path& file, const fs::path& allowed_folder,
               const FileReader& read_file)
      : container_(container),
        place_{file.string()},
        allowed_folder_(allowed_folder),
        read_file_(read_file) {
    std::error_code status;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file, status).parent_path(), status);
    from_allowed_folder_ = folder.lexically_relative(fs::weakly_canonical(allowed_folder, status));
  }

  // Throws InputError E-PATH.
  fs::path resolved(const std::string& uri, const std::string& field) const {
    const std::string decoded = percent_decoded(uri);
    // Looked for here because behind a folder name a scheme would pass for a part of the path.
    if (decoded.find(':') < decoded.find('/'))
      core::throw_input_error(ErrorClass::path, place_, field, "\"" + uri + "\"",
                              "a relative path, not a URI scheme");
    const fs::path path = from_allowed_folder_ / decoded;
    return core::path_inside(allowed_folder_, path.string(), place_, field);
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
    if (source.uri.starts_with(kDataScheme)) return decoded_data(source.uri, field);
    std::string bytes = read_file_(resolved(source.uri, field), readable_bytes_);
    readable_bytes_ -= bytes.size();
    return bytes;
  }

  std::string decoded_data(const std::string& uri, const std::string& field) const {
    const std::size_t mark = uri.substr(0, uri.find(',') + 1).find(kBase64Mark);
    if (mark == std::string::npos)
      core::throw_input_error(ErrorClass::unsupported, place_, field, uri.substr(0, 40),
                              "a data: URI in base64");
    // The decoder knows few media types; which one a buffer claims to be does not matter.
    std::string media_type;
    std::vector<unsigned char> bytes;
    tinygltf::DecodeDataURI(&bytes, media_type, "data:application/octet-stream" + uri.substr(mark),
                            0, false);
    return {bytes.begin(), bytes.end()};
  }

  const GltfContainer& container_;
  core::Place place_;
  const fs::path& allowed_folder_;
  const FileReader& read_file_;
  fs::path from_allowed_folder_;
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
    if (uri.empty() || uri.starts_with(kDataScheme)) continue;
    try {
      loader.resolved(uri, "images[" + std::to_string(i) + "].uri");
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  return buffers;
}

}  // namespace fanbeam::terrain
