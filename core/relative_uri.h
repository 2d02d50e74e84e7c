// Where a file that another file names by a URI lies, and what URIs are made of.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::core {

// Of "%" with two hexadecimal digits the byte (RFC 3986, section 2.1); any other "%" stays as it is.
struct PercentDecoded {
  std::string bytes;
  std::size_t wrong = std::string::npos;  // in the text: the first "%" without two digits
};
PercentDecoded percent_decoded(std::string_view text);

// "http:", "HTTPS:", "ftp:", "file:" and "data:", and any other scheme (section 3.1) before "//". Names of
// files may have colons: "flight_08:30.csv" is none.
bool has_uri_scheme(std::string_view text);

// The file that `uri`, found in `from_file`, stands for: relative to that file, and inside
// `allowed_folder` with symbolic links followed. "%20" and its like are decoded. Throws InputError
// E-PATH for a scheme, an absolute path and one that leaves the folder; `place` and `field` go into
// the message.
std::filesystem::path file_of_uri(const std::filesystem::path& allowed_folder,
                                  const std::filesystem::path& from_file, const std::string& uri,
                                  const Place& place, const std::string& field);

}  // namespace fanbeam::core
