// What the fuzz targets share: a file of their own to put an input into, and what an input may do.
//
// A target feeds libFuzzer's bytes to the reader that a user's file would reach. An input may be
// taken or be refused with core::InputError; everything else is a fault of the product: any other
// exception, a sanitizer's report, a hang, a promise of the reader's header broken (must()).
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/errors.h"

namespace fanbeam::fuzz {

// Ends the process, as a sanitizer does, when the product broke a promise.
inline void must(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "fuzz: broken promise: %s\n", promise);
  std::abort();
}

// A folder in memory for this process alone, gone when it ends in good order.
inline const std::filesystem::path& scratch_folder() {
  struct Folder {
    Folder() {
      std::error_code none;
      const std::filesystem::path memory = "/dev/shm";
      path =
          (std::filesystem::is_directory(memory, none) ? memory
                                                       : std::filesystem::temp_directory_path()) /
          ("fanbeam_fuzz_" + std::to_string(getpid()));
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
  };
  static const Folder folder;
  return folder.path;
}

// The one file of this process with that name, holding `bytes`.
inline std::filesystem::path scratch_file(const std::string& name, std::string_view bytes) {
  std::filesystem::path file = scratch_folder() / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Calls `read` with a list for its problems. What it throws as an InputError must name an error.
template <typename Read>
void expect_answer(Read read) {
  core::ProblemList problems;
  try {
    read(problems);
  } catch (const core::InputError& error) {
    bool has_error = false;
    for (const core::Problem& problem : error.problems()) {
      has_error = has_error || problem.is_error();
      must(!core::to_string(problem).empty(), "a problem has words");
    }
    must(has_error, "a refusal names an error");
  }
}

}  // namespace fanbeam::fuzz
