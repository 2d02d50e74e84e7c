// Hands out the lines of a text file one by one, so that memory does not grow with the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::scenes {

// A byte order mark, CRLF line ends, blanks around a line, blank lines and lines beginning with '#'
// are passed over.
class LineReader {
 public:
  static constexpr std::size_t kLongestLine_bytes = 65536;

  // Adds E-IO to `problems` for what is no readable file.
  LineReader(const std::filesystem::path& path, core::ProblemList& problems);

  // The next line that holds something, good until the next call; false at the end or after adding
  // E-IO, or E-LIMIT for a line of kLongestLine_bytes or more.
  bool next(std::string_view& line);

  // Of the line handed out last.
  const core::Place& place() const { return place_; }

 private:
  std::ifstream stream_;
  core::Place place_;
  core::ProblemList& problems_;
  std::string buffer_;
};

}  // namespace fanbeam::scenes
