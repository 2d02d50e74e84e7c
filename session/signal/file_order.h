// Files of frames, in the order of the numbers in their names.
#pragma once

#include <filesystem>

namespace fanbeam::session {

// By name, whatever the folder, numbers by their values: "frame_2" comes before "frame_10", 99999.json before
// 100000.json, and, of decimals, "0.15" before "0.2". Of two different names one always comes first.
bool comes_before(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace fanbeam::session
