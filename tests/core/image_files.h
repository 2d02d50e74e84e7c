// Small pictures for tests, and what happens to their files.
#pragma once

#include <filesystem>
#include <string>

#include "core/files.h"
#include "core/image.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

inline std::string bytes_of(const std::filesystem::path& path) {
  return core::read_file(path, 100U << 20U);
}

inline core::Picture8 gradient(int columns, int rows) {
  core::Picture8 picture{columns, rows, {}};
  for (int i = 0; i < columns * rows; ++i)
    picture.pixels.push_back(static_cast<std::uint8_t>(i * 7 % 256));
  return picture;
}

inline core::Image two_layers() {
  return {
      3, 2, {{"power_W", {0.0, 1e-30, 1e-12, 1.0, 3.5, 1e20}}, {"range_m", {1, 2, 3, 4, 5, 6}}}};
}

inline const core::Metadata kNotes = {
    {"Software", "fanbeam 1"}, {"fanbeam:scene", "Zürich"}, {"fanbeam:events", "one two"}};

}  // namespace fanbeam::tests
