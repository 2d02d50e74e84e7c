#include "core/image.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::core {
namespace {

constexpr std::int64_t kMostValues = 32'000'000;

std::size_t cells(int columns, int rows) {
  if (columns < 1 || rows < 1) throw InternalError("a picture without pixels");
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

void write(const std::filesystem::path& path, OIIO::ImageSpec& spec, const Metadata& metadata, OIIO::TypeDesc type,
           const void* pixels) {
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    const auto refuse = [&](const std::string& reason) {
      throw_input_error(ErrorClass::io, Place{path.string()}, "", reason, "a file that can be written");
    };
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(temporary.string());
    if (!output) refuse(OIIO::geterror());
    if (!output->open(temporary.string(), spec) || !output->write_image(type, pixels) || !output->close())
      refuse(output->geterror());
  });
}

// Keeps sizes that a file only claims away from every allocation.
void check_size(const Place& place, std::int64_t columns, std::int64_t rows, std::int64_t channels) {
  const std::string found = std::to_string(columns) + " x " + std::to_string(rows) + " x " + std::to_string(channels);
  if (columns < 1 || rows < 1 || channels < 1)
    throw_input_error(ErrorClass::parse, place, "image size", found, "at least one value");
  if (columns > kMostValues || rows > kMostValues / columns || channels > kMostValues / (columns * rows))
    throw_input_error(ErrorClass::limit, place, "image size", found, "at most " + std::to_string(kMostValues) + " values");
}

// PNG: the size stands at byte 16 (ISO/IEC 15948:2004, 11.2.2), seen before the library sees the file.
void check_png_size(const std::filesystem::path& path) {
  std::array<unsigned char, 24> head{};
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  if (stream.gcount() < 24 || std::memcmp(head.data(), "\x89PNG\r\n\x1a\n", 8) != 0) return;
  const auto number = [&](std::size_t at) {
    return std::int64_t{head[at]} << 24 | head[at + 1] << 16 | head[at + 2] << 8 | head[at + 3];
  };
  check_size(Place{path.string()}, number(16), number(20), 1);
}

std::unique_ptr<OIIO::ImageInput> open(const std::filesystem::path& path) {
  const Place place{path.string()};
  if (!std::filesystem::is_regular_file(path))
    throw_input_error(ErrorClass::io, place, "", "missing", "an image file");
  check_png_size(path);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw_input_error(ErrorClass::parse, place, "", OIIO::geterror(), "an image file");
  return input;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture8& picture, const Metadata& metadata) {
  if (picture.pixels.size() != cells(picture.columns, picture.rows)) throw InternalError("picture size");
  OIIO::ImageSpec spec(picture.columns, picture.rows, 1, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", 6);
  write(path, spec, metadata, OIIO::TypeDesc::UINT8, picture.pixels.data());
}

void write_exr(const std::filesystem::path& path, const Image& image, const Metadata& metadata) {
  const auto layers = image.layers.size();
  OIIO::ImageSpec spec(image.columns, image.rows, static_cast<int>(layers), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Image::Layer& layer : image.layers) spec.channelnames.push_back(layer.name);
  spec.attribute("compression", "zip");
  const std::size_t count = cells(image.columns, image.rows);
  std::vector<float> pixels(count * layers);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::vector<double>& values = image.layers[layer].values;
    if (values.size() != count) throw InternalError("size of layer " + image.layers[layer].name);
    for (std::size_t i = 0; i < count; ++i) pixels[i * layers + layer] = static_cast<float>(values[i]);
  }
  write(path, spec, metadata, OIIO::TypeDesc::FLOAT, pixels.data());
}

Metadata read_metadata(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open(path);
  Metadata metadata;
  for (const OIIO::ParamValue& attribute : input->spec().extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING) metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return metadata;
}

Image read_image(const std::filesystem::path& path) {
  const Place place{path.string()};
  const std::unique_ptr<OIIO::ImageInput> input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  check_size(place, spec.width, spec.height, spec.nchannels);
  const double largest = spec.format == OIIO::TypeDesc::UINT8 ? 255.0 : spec.format == OIIO::TypeDesc::UINT16 ? 65535.0 : 0.0;
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

}  // namespace fanbeam::core
