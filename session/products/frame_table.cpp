#include "session/products/frame_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <optional>

namespace fanbeam::session {

std::string table_head(const std::string& what, const core::Metadata& metadata) {
  std::string head = fmt::format("# {}\n", what);
  for (const auto& [name, value] : metadata) head += fmt::format("# {} {}\n", name, value);
  return head;
}

core::Metadata table_metadata(const std::filesystem::path& table) {
  core::Metadata metadata;
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);  // what it is
  while (std::getline(stream, line) && line.starts_with("# ")) {
    const std::size_t blank = std::min(line.find(' ', 2), line.size());
    metadata.emplace_back(line.substr(2, blank - 2),
                          blank < line.size() ? line.substr(blank + 1) : "");
  }
  return metadata;
}

bool is_whole_table(const std::filesystem::path& table) {
  std::ifstream stream(table);
  std::optional<std::ptrdiff_t> of_names;
  for (std::string line; std::getline(stream, line);) {
    if (stream.eof()) return false;  // cut within it
    if (!of_names && line.starts_with('#')) continue;
    const std::ptrdiff_t commas = std::count(line.begin(), line.end(), ',');
    if (commas != of_names.value_or(commas)) return false;
    of_names = commas;
  }
  return of_names && !stream.bad();
}

std::filesystem::path frame_table_path(const std::filesystem::path& folder,
                                       const std::string& product, int frame) {
  return folder / product / fmt::format("{:05}.csv", frame);
}

}  // namespace fanbeam::session
