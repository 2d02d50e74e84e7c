// A look at a PNG file before the library sees it: the library prints to standard error where a
// file is damaged, and believes the size in its head.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace fanbeam::core {

struct ClaimedSize {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
};

// Walks all chunks up to the end chunk and checks their order, lengths and checksums, and that the
// picture data inflate to as many bytes as the head promises, each row with a filter that there is
// (ISO/IEC 15948:2004, 5, 9 and 10, annex D). Memory stays small whatever the file says. `accept`
// gets the size in the head before anything else is looked at, and may throw. False, and nothing
// checked, where the file does not begin as a PNG file does. Throws InputError: E-PARSE with the byte
// where it is damaged or ends too early, E-IO.
bool check_png(const std::filesystem::path& path,
               const std::function<void(const ClaimedSize&)>& accept);

}  // namespace fanbeam::core
