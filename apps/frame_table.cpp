#include "apps/frame_table.h"

#include <fmt/core.h>

#include <fstream>

namespace fanbeam::apps {

std::string table_comment(const std::string& what, const std::string& fingerprint) {
  return fmt::format("# {} of the input {}", what, fingerprint);
}

std::filesystem::path frame_table_path(const std::filesystem::path& folder,
                                       const std::string& product, int frame) {
  return folder / product / fmt::format("{:05}.csv", frame);
}

bool has_frame_table(const std::filesystem::path& folder, const std::string& product, int frame,
                     const std::string& fingerprint) {
  std::ifstream stream(frame_table_path(folder, product, frame));
  std::string line;
  return std::getline(stream, line) && line.ends_with(" of the input " + fingerprint);
}

}  // namespace fanbeam::apps
