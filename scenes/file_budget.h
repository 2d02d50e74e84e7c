// How much the files of all models and buildings of one scene may be together, and which they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace fanbeam::scenes {

// A scene may place one file thousands of times, and each time it is read.
inline constexpr std::uint64_t kMostBodyFiles_bytes = std::uint64_t{1} << 30;

class FileBudget {
 public:
  // The file's bytes, as core::read_file. Throws InputError E-LIMIT, before reading, when they are
  // more than `largest_bytes` or than the budget has left.
  std::string read(const std::filesystem::path& file, std::uint64_t largest_bytes);
  // Those read, each once.
  const std::set<std::filesystem::path>& files() const { return files_; }

 private:
  std::set<std::filesystem::path> files_;
  std::uint64_t left_bytes_ = kMostBodyFiles_bytes;
};

}  // namespace fanbeam::scenes
