// What this process has open, to make its system calls fail.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace fanbeam::tests {

// The descriptor by which the file is open; -1 for none.
inline int open_descriptor(const std::filesystem::path& file) {
  std::error_code gone;  // that by which the folder is read
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    if (std::filesystem::equivalent(entry.path(), file, gone))
      return std::stoi(entry.path().filename().string());
  return -1;
}

}  // namespace fanbeam::tests
