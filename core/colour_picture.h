// Pictures in colour, and their PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/image.h"

namespace fanbeam::core {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

// Row-major, top row first.
struct ColourPicture {
  int columns = 0;
  int rows = 0;
  std::vector<Colour> pixels;
};

// As write_png of a grey picture.
void write_png(const std::filesystem::path& path, const ColourPicture& picture,
               const Metadata& metadata);

}  // namespace fanbeam::core
