// A short text that tells one input from another.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::session {

// `files`, and behind a raster those of its name ("dem.tfw", "dem.tif.aux.xml").
std::vector<std::filesystem::path> with_companions(const std::vector<std::filesystem::path>& files);

// 16 hexadecimal digits of `settings` and of the bytes of `files` with their companions. Tells inputs apart,
// guards nothing (FNV-1a, 64 bits). Files that are not there count as empty.
std::string fingerprint_of(std::string_view settings,
                           const std::vector<std::filesystem::path>& files);

}  // namespace fanbeam::session
