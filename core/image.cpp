#include "core/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

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

// `name` has the format's ending.
std::string encoded(const std::string& name, OIIO::ImageSpec& spec, const Metadata& metadata,
                    OIIO::TypeDesc type, const void* pixels) {
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  const std::unique_ptr<OIIO::ImageOutput> output =
      OIIO::ImageOutput::create(name.substr(name.rfind('.') + 1));
  if (!output) throw InternalError("no writer of " + name + ": " + OIIO::geterror());
  OIIO::Filesystem::IOVecOutput bytes;
  if (!output->set_ioproxy(&bytes) || !output->open(name, spec) ||
      !output->write_image(type, pixels) || !output->close())
    throw InternalError("writing " + name + " to memory: " + output->geterror());
  const std::vector<unsigned char>& buffer = bytes.buffer();
  return {reinterpret_cast<const char*>(buffer.data()), buffer.size()};
}

// Through memory: the libraries' own file output does not tell when the disk is full.
void write(const std::filesystem::path& path, OIIO::ImageSpec& spec, const Metadata& metadata,
           OIIO::TypeDesc type, const void* pixels) {
  write_file_atomically(path, encoded(path.filename().string(), spec, metadata, type, pixels));
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

std::unique_ptr<OIIO::ImageInput> open(const std::filesystem::path& path) {
  const Place place{path.string()};
  if (!std::filesystem::is_regular_file(path))
    throw_input_error(ErrorClass::io, place, "", "missing", "an image file");
  check_png(path, [&](const ClaimedSize& claimed) {
    constexpr std::int64_t kLongestSide = 1'000'000;  // of the PNG library
    check_size(place, claimed.columns, claimed.rows, 1);
    if (const std::int64_t side = std::max(claimed.columns, claimed.rows); side > kLongestSide)
      throw_input_error(ErrorClass::limit, place, "image size", std::to_string(side),
                        "at most " + std::to_string(kLongestSide) + " on a side");
  });
  check_exr(path, [&](const ClaimedSize& claimed) {
    check_size(place, claimed.columns, claimed.rows, 1);
  });
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw_input_error(ErrorClass::parse, place, "", OIIO::geterror(), "an image file");
  return input;
}

// Of a grey or a coloured picture.
template <class AnyPicture>
OIIO::ImageSpec picture_spec(const AnyPicture& picture) {
  using Pixel = typename decltype(picture.pixels)::value_type;
  if (picture.pixels.size() != cells(picture.columns, picture.rows))
    throw InternalError("picture size");
  return {picture.columns, picture.rows, static_cast<int>(sizeof(Pixel)), OIIO::TypeDesc::UINT8};
}

template <class AnyPicture>
OIIO::ImageSpec png_spec(const AnyPicture& picture) {
  OIIO::ImageSpec spec = picture_spec(picture);
  spec.attribute("png:compressionLevel", 2);  // writing must not hold up rendering
  return spec;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture8& picture,
               const Metadata& metadata) {
  OIIO::ImageSpec spec = png_spec(picture);
  write(path, spec, metadata, OIIO::TypeDesc::UINT8, picture.pixels.data());
}

void write_png(const std::filesystem::path& path, const ColourPicture& picture,
               const Metadata& metadata) {
  static_assert(sizeof(Colour) == 3);
  OIIO::ImageSpec spec = png_spec(picture);
  write(path, spec, metadata, OIIO::TypeDesc::UINT8, picture.pixels.data());
}

std::string png_bytes(const Picture8& picture) {
  OIIO::ImageSpec spec = png_spec(picture);
  return encoded("memory.png", spec, {}, OIIO::TypeDesc::UINT8, picture.pixels.data());
}

std::string jpeg_bytes(const Picture8& picture) {
  OIIO::ImageSpec spec = picture_spec(picture);
  spec.attribute("Compression", "jpeg:90");
  return encoded("memory.jpeg", spec, {}, OIIO::TypeDesc::UINT8, picture.pixels.data());
}

void write_exr(const std::filesystem::path& path, const Image& image, const Metadata& metadata) {
  const auto layers = image.layers.size();
  OIIO::ImageSpec spec(image.columns, image.rows, static_cast<int>(layers), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Image::Layer& layer : image.layers) spec.channelnames.push_back(layer.name);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else the time of writing
  const std::size_t count = cells(image.columns, image.rows);
  std::vector<float> pixels(count * layers);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::vector<double>& values = image.layers[layer].values;
    if (values.size() != count) throw InternalError("size of layer " + image.layers[layer].name);
    for (std::size_t i = 0; i < count; ++i)
      pixels[i * layers + layer] = static_cast<float>(values[i]);
  }
  write(path, spec, metadata, OIIO::TypeDesc::FLOAT, pixels.data());
}

Metadata read_metadata(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open(path);
  Metadata metadata;
  for (const OIIO::ParamValue& attribute : input->spec().extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return metadata;
}

ImageSize image_size(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open(path);
  return {input->spec().width, input->spec().height, input->spec().nchannels};
}

Image read_image(const std::filesystem::path& path) {
  const Place place{path.string()};
  const std::unique_ptr<OIIO::ImageInput> input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  check_size(place, spec.width, spec.height, spec.nchannels);
  const double largest = spec.format == OIIO::TypeDesc::UINT8    ? 255.0
                         : spec.format == OIIO::TypeDesc::UINT16 ? 65535.0
                                                                 : 0.0;
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> pixels(cells(spec.width, spec.height) * channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    throw_input_error(ErrorClass::parse, place, "", input->geterror(), "a complete image");
  Image image{spec.width, spec.height, {}};
  for (std::size_t channel = 0; channel < channels; ++channel) {
    Image::Layer layer{spec.channelnames[channel], {}};
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
