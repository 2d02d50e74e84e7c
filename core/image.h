// Pictures and layered images, and their files (PNG, OpenEXR through OpenImageIO).
//
// Written files hold no time and no host name: the same image gives the same bytes. Files are
// written under a temporary name and renamed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace fanbeam::core {

using Metadata = std::vector<std::pair<std::string, std::string>>;

// 8-bit grey, row-major, top row first.
struct Picture8 {
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> pixels;
};

// Named layers of equal size, row-major, top row first; doubles inside, 32-bit floats in files.
struct Image {
  struct Layer {
    std::string name;
    std::vector<double> values;
  };
  int columns = 0;
  int rows = 0;
  std::vector<Layer> layers;
};

// Throws InputError E-IO when the file cannot be written; an old file is then untouched. Sizes that
// do not match the values are a broken invariant (InternalError).
void write_png(const std::filesystem::path& path, const Picture8& picture,
               const Metadata& metadata);
void write_exr(const std::filesystem::path& path, const Image& image, const Metadata& metadata);

struct ImageSize {
  int columns = 0;
  int rows = 0;
  int layers = 0;
  bool operator==(const ImageSize&) const = default;
};
// What a file's head says, before any pixel is held. Throws as read_image does.
ImageSize image_size(const std::filesystem::path& path);

// The texts stored with an image. Throws InputError E-IO or E-PARSE.
Metadata read_metadata(const std::filesystem::path& path);

// PNG and OpenEXR, told by the first bytes. Floats come back as they are, whole numbers as stored: 0 to 255 for
// 8 bits, 0 to 65535 for 16; palettes as colours. Throws InputError: E-IO (missing), E-PARSE
// (damaged, or another format), E-LIMIT before allocation above 32 million values.
Image read_image(const std::filesystem::path& path);

// "OpenImageIO 2.4.7.1": what writes pictures, for records.
std::string image_library();

}  // namespace fanbeam::core
