// Files of pictures as plain numbers: what core/image.cpp has OpenImageIO do.
//
// In a library of its own, libfanbeam-pictures.so, which is loaded with the first picture. OpenImageIO brings 145
// shared libraries along (OpenCV, VTK, GDCM, an FFmpeg under the GPL): loading them took three quarters of the time
// in which a program started, and a host of libfanbeam.so that reads no pictures has none of them in its process.
// Faults come back as texts, so that what a caller is told is said in one place.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fanbeam::core {

// Row-major, top row first, channels side by side: `bytes` or `floats`.
struct PixelsToEncode {
  std::string name{};  // has the format's ending
  int columns = 0, rows = 0, channels = 1;
  const std::uint8_t* bytes = nullptr;
  const float* floats = nullptr;
  std::vector<std::string> channel_names{};  // none: the format's own
  std::vector<std::pair<std::string, std::string>> texts{};
};

class ImageFile {
 public:
  enum class Depth { bits_8, bits_16, other };

  virtual ~ImageFile() = default;
  virtual int columns() const = 0;
  virtual int rows() const = 0;
  virtual int channels() const = 0;
  virtual std::vector<std::string> channel_names() const = 0;
  virtual Depth depth() const = 0;
  virtual std::vector<std::pair<std::string, std::string>> texts() const = 0;
  // Whole numbers as shares of their largest. False with a `fault`.
  virtual bool read(float* pixels, std::string& fault) = 0;
};

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // The bytes of a file; none with a `fault`.
  virtual std::string encode(const PixelsToEncode& pixels, std::string& fault) const = 0;
  // `format` by OpenImageIO's name, whatever the file is called: "png", "openexr". Null with a `fault`.
  virtual std::unique_ptr<ImageFile> open(const std::string& path, const std::string& format,
                                          std::string& fault) const = 0;
};

}  // namespace fanbeam::core

// The library's one symbol. Its number rises with every change of what stands above: another version's library is
// none.
extern "C" [[gnu::visibility("default")]] const fanbeam::core::ImageCodec* fanbeam_image_codec_2();
