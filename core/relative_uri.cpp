#include "core/relative_uri.h"

#include <charconv>

#include "core/files.h"

namespace fanbeam::core {
namespace {

namespace fs = std::filesystem;

// What is no "%" with two digits stays as it is.
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

}  // namespace

fs::path file_of_uri(const fs::path& allowed_folder, const fs::path& from_file,
                     const std::string& uri, const Place& place, const std::string& field) {
  const std::string decoded = percent_decoded(uri);
  // Looked for here because behind a folder name a scheme would pass for a part of the path.
  if (decoded.find(':') < decoded.find('/'))
    throw_input_error(ErrorClass::path, place, field, "\"" + uri + "\"",
                      "a relative path, not a URI scheme");
  std::error_code status;
  const fs::path folder =
      fs::weakly_canonical(fs::absolute(from_file, status).parent_path(), status);
  const fs::path from_allowed_folder =
      folder.lexically_relative(fs::weakly_canonical(allowed_folder, status));
  return path_inside(allowed_folder, (from_allowed_folder / decoded).string(), place, field);
}

}  // namespace fanbeam::core
