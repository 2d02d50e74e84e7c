// A short text that tells one input from another.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::session {

// 16 hexadecimal digits of `settings`, of the bytes of `files`, and of a raster's files of the same
// name ("dem.tfw", "dem.tif.aux.xml"). Tells inputs apart, guards nothing (FNV-1a, 64 bits). Files that
// are not there count as empty.
std::string fingerprint_of(std::string_view settings,
                           const std::vector<std::filesystem::path>& files);

}  // namespace fanbeam::session
