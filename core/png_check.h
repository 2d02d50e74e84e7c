// A look at a PNG file before the library sees it: the library prints to standard error where a
// file is damaged, and believes the size in its head.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace fanbeam::core {

struct ClaimedSize {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
};

// The size that the file claims, or nothing when it does not begin as a PNG file does. Walks all
// chunks up to the end chunk and checks their lengths and checksums (ISO/IEC 15948:2004, 5.3 and
// annex D); memory stays small whatever the file says. Throws InputError: E-PARSE with the byte
// where it is damaged or ends too early, E-IO.
std::optional<ClaimedSize> check_png(const std::filesystem::path& path);

}  // namespace fanbeam::core
