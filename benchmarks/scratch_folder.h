// A folder that is gone with its owner.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace fanbeam::benchmarks {

class ScratchFolder {
 public:
  ScratchFolder() { std::filesystem::create_directories(path_); }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("fanbeam-bench-" + std::to_string(getpid()));
};

// The program that is built beside this one.
inline std::filesystem::path program_beside() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "fanbeam";
}

}  // namespace fanbeam::benchmarks
