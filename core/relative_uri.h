// Where a file that another file names by a URI lies.
#pragma once

#include <filesystem>
#include <string>

#include "core/errors.h"

namespace fanbeam::core {

// The file that `uri`, found in `from_file`, stands for: relative to that file, and inside
// `allowed_folder` with symbolic links followed. "%20" and its like are decoded (RFC 3986, section
// 2.1). Throws InputError E-PATH for a scheme, an absolute path and one that leaves the folder;
// `place` and `field` go into the message.
std::filesystem::path file_of_uri(const std::filesystem::path& allowed_folder,
                                  const std::filesystem::path& from_file, const std::string& uri,
                                  const Place& place, const std::string& field);

}  // namespace fanbeam::core
