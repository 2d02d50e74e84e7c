#include "scenes/line_reader.h"

#include "core/files.h"
#include "core/text.h"

namespace fanbeam::scenes {

using core::ErrorClass;

LineReader::LineReader(const std::filesystem::path& path, core::ProblemList& problems)
    : stream_(core::open_file(path, problems)),
      place_{path.string()},
      problems_(problems),
      buffer_(kLongestLine_bytes, '\0') {}

bool LineReader::next(std::string_view& line) {
  while (stream_.good()) {
    stream_.getline(buffer_.data(), static_cast<std::streamsize>(kLongestLine_bytes));
    const auto count = static_cast<std::size_t>(stream_.gcount());
    if (count > 0 || place_.line == 0) ++place_.line;
    if (stream_.bad()) {
      problems_.error(ErrorClass::io, {place_.file}, "", "read failed", "a readable file");
      return false;
    }
    if (stream_.fail() && count > 0) {
      problems_.error(ErrorClass::limit, place_, "line length", "65536 bytes or more",
                      "a shorter line");
      return false;
    }
    line = std::string_view(buffer_).substr(0, stream_.eof() || count == 0 ? count : count - 1);
    if (place_.line == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    line = core::trimmed(line);
    if (!line.empty() && line.front() != '#') return true;
  }
  return false;
}

}  // namespace fanbeam::scenes
