#include "core/image.h"

#include <OpenImageIO/oiioversion.h>
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "core/codec/image_codec_private.h"
#include "core/colour_picture.h"
#include "core/errors.h"
#include "core/exr_check.h"
#include "core/files.h"
#include "core/picture_bytes.h"
#include "core/png_check.h"

namespace fanbeam::core {
namespace {

constexpr std::int64_t kMostValues = 32'000'000;

std::size_t cells(int columns, int rows) {
  if (columns < 1 || rows < 1) throw InternalError("a picture without pixels");
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

// Looked for where the program or library that holds this code looks for its own.
const ImageCodec& load_codec() {
  constexpr const char* kLibrary = "libfanbeam-pictures.so.0";
  void* const library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
  void* const entry = library != nullptr ? dlsym(library, "fanbeam_image_codec_2") : nullptr;
  if (entry == nullptr)
    throw_input_error(ErrorClass::io, Place{kLibrary}, "", dlerror(),
                      "the part of fanbeam that reads and writes pictures");
  return *reinterpret_cast<decltype(&fanbeam_image_codec_2)>(entry)();
}

const ImageCodec& codec() {
  static const ImageCodec& loaded = load_codec();
  return loaded;
}

std::string encoded(const PixelsToEncode& pixels) {
  std::string fault;
  std::string bytes = codec().encode(pixels, fault);
  if (!fault.empty() || bytes.empty())
    throw InternalError("writing " + pixels.name + " to memory: " + fault);
  return bytes;
}

// Through memory: the libraries' own file output does not tell when the disk is full.
void write(const std::filesystem::path& path, PixelsToEncode pixels, const Metadata& metadata) {
  pixels.name = path.filename().string();
  pixels.texts.insert(pixels.texts.end(), metadata.begin(), metadata.end());
  write_file_atomically(path, encoded(pixels));
}

// Keeps sizes that a file only claims away from every allocation.
void check_size(const Place& place, std::int64_t columns, std::int64_t rows,
                std::int64_t channels) {
  const std::string found =
      std::to_string(columns) + " x " + std::to_string(rows) + " x " + std::to_string(channels);
  if (columns < 1 || rows < 1 || channels < 1)
    throw_input_error(ErrorClass::parse, place, "image size", found, "at least one value");
  if (columns > kMostValues || rows > kMostValues / columns ||
      channels > kMostValues / (columns * rows))
    throw_input_error(ErrorClass::limit, place, "image size", found,
                      "at most " + std::to_string(kMostValues) + " values");
}

// By its first bytes, whatever it is called.
std::unique_ptr<ImageFile> open(const std::filesystem::path& path) {
  const Place place{path.string()};
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status))
    throw_input_error(ErrorClass::io, place, "", status ? status.message() : "not a file",
                      "an image file");
  const bool is_png = check_png(path, [&](const ClaimedSize& claimed) {
    constexpr std::int64_t kLongestSide = 1'000'000;  // of the PNG library
    check_size(place, claimed.columns, claimed.rows, 1);
    if (const std::int64_t side = std::max(claimed.columns, claimed.rows); side > kLongestSide)
      throw_input_error(ErrorClass::limit, place, "image size", std::to_string(side),
                        "at most " + std::to_string(kLongestSide) + " on a side");
  });
  const bool is_exr = !is_png && check_exr(path, [&](const ClaimedSize& claimed) {
    check_size(place, claimed.columns, claimed.rows, 1);
  });
  if (!is_png && !is_exr)
    throw_input_error(ErrorClass::parse, place, "", "another format", "a PNG or OpenEXR image");
  std::string fault;
  std::unique_ptr<ImageFile> file = codec().open(path.string(), is_png ? "png" : "openexr", fault);
  if (!file) throw_input_error(ErrorClass::parse, place, "", fault, "an image file");
  return file;
}

// Of a grey or a coloured picture.
template <class AnyPicture>
PixelsToEncode pixels_of(const AnyPicture& picture, const char* name) {
  using Pixel = typename decltype(picture.pixels)::value_type;
  if (picture.pixels.size() != cells(picture.columns, picture.rows))
    throw InternalError("picture size");
  return {.name = name,
          .columns = picture.columns,
          .rows = picture.rows,
          .channels = static_cast<int>(sizeof(Pixel)),
          .bytes = reinterpret_cast<const std::uint8_t*>(picture.pixels.data())};
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture8& picture,
               const Metadata& metadata) {
  write(path, pixels_of(picture, ""), metadata);
}

void write_png(const std::filesystem::path& path, const ColourPicture& picture,
               const Metadata& metadata) {
  static_assert(sizeof(Colour) == 3);
  write(path, pixels_of(picture, ""), metadata);
}

std::string png_bytes(const Picture8& picture) { return encoded(pixels_of(picture, "memory.png")); }

std::string jpeg_bytes(const Picture8& picture) {
  PixelsToEncode pixels = pixels_of(picture, "memory.jpeg");
  pixels.texts = {{"Compression", "jpeg:90"}};
  return encoded(pixels);
}

void write_exr(const std::filesystem::path& path, const Image& image, const Metadata& metadata) {
  const auto layers = image.layers.size();
  const std::size_t count = cells(image.columns, image.rows);
  std::vector<float> values_of_pixels(count * layers);
  PixelsToEncode pixels{.columns = image.columns,
                        .rows = image.rows,
                        .channels = static_cast<int>(layers),
                        .floats = values_of_pixels.data(),
                        // No date: else the time of writing.
                        .texts = {{"compression", "zip"}, {"DateTime", ""}}};
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::vector<double>& values = image.layers[layer].values;
    if (values.size() != count) throw InternalError("size of layer " + image.layers[layer].name);
    pixels.channel_names.push_back(image.layers[layer].name);
    for (std::size_t i = 0; i < count; ++i)
      values_of_pixels[i * layers + layer] = static_cast<float>(values[i]);
  }
  write(path, std::move(pixels), metadata);
}

Metadata read_metadata(const std::filesystem::path& path) { return open(path)->texts(); }

ImageSize image_size(const std::filesystem::path& path) {
  const std::unique_ptr<ImageFile> file = open(path);
  return {file->columns(), file->rows(), file->channels()};
}

Image read_image(const std::filesystem::path& path) {
  const Place place{path.string()};
  const std::unique_ptr<ImageFile> file = open(path);
  check_size(place, file->columns(), file->rows(), file->channels());
  const std::vector<std::string> names = file->channel_names();
  const auto channels = static_cast<std::size_t>(file->channels());
  const double largest = file->depth() == ImageFile::Depth::bits_8    ? 255.0
                         : file->depth() == ImageFile::Depth::bits_16 ? 65535.0
                                                                      : 0.0;
  std::vector<float> pixels(cells(file->columns(), file->rows()) * channels);
  if (std::string fault; !file->read(pixels.data(), fault))
    throw_input_error(ErrorClass::parse, place, "", fault, "a complete image");
  Image image{file->columns(), file->rows(), {}};
  for (std::size_t channel = 0; channel < channels; ++channel) {
    Image::Layer layer{names[channel], {}};
    layer.values.reserve(pixels.size() / channels);
    for (std::size_t i = channel; i < pixels.size(); i += channels)
      layer.values.push_back(largest > 0.0 ? std::round(static_cast<double>(pixels[i]) * largest)
                                           : static_cast<double>(pixels[i]));
    image.layers.push_back(std::move(layer));
  }
  return image;
}

std::string image_library() { return std::string("OpenImageIO ") + OIIO_VERSION_STRING; }

}  // namespace fanbeam::core
