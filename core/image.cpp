#include "core/image.h"

#include <OpenImageIO/imageio.h>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::core {
namespace {

constexpr std::int64_t kMostValues = 32'000'000;

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

}  // namespace

void write_png(const std::filesystem::path& path, const Picture8& picture, const Metadata& metadata) {
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
  std::vector<float> pixels(static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows) * layers);
  for (std::size_t layer = 0; layer < layers; ++layer)
    for (std::size_t i = 0; i < image.layers[layer].values.size(); ++i)
      pixels[i * layers + layer] = static_cast<float>(image.layers[layer].values[i]);
  write(path, spec, metadata, OIIO::TypeDesc::FLOAT, pixels.data());
}

Metadata read_metadata(const std::filesystem::path& path) {
  const Place place{path.string()};
  if (!std::filesystem::is_regular_file(path))
    throw_input_error(ErrorClass::io, place, "", "missing", "an image file");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw_input_error(ErrorClass::parse, place, "", OIIO::geterror(), "an image file");
  Metadata metadata;
  for (const OIIO::ParamValue& attribute : input->spec().extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING) metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return metadata;
}

Image read_image(const std::filesystem::path& path) {
  const Place place{path.string()};
  if (!std::filesystem::is_regular_file(path))
    throw_input_error(ErrorClass::io, place, "", "missing", "an image file");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw_input_error(ErrorClass::parse, place, "", OIIO::geterror(), "an image file");
  const OIIO::ImageSpec& spec = input->spec();
  const std::int64_t values = static_cast<std::int64_t>(spec.width) * spec.height * std::max(1, spec.nchannels);
  if (spec.width < 1 || spec.height < 1)
    throw_input_error(ErrorClass::parse, place, "image size", std::to_string(spec.width) + " x " + std::to_string(spec.height), "at least 1 x 1");
  if (values > kMostValues)
    throw_input_error(ErrorClass::limit, place, "image size",
                      std::to_string(spec.width) + " x " + std::to_string(spec.height) + " x " + std::to_string(spec.nchannels),
                      "at most " + std::to_string(kMostValues) + " values");
  const bool bytes = spec.format == OIIO::TypeDesc::UINT8;
  std::vector<float> pixels(static_cast<std::size_t>(values));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    throw_input_error(ErrorClass::parse, place, "", input->geterror(), "a complete image");
  Image image{spec.width, spec.height, {}};
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  for (std::size_t channel = 0; channel < channels; ++channel) {
    Image::Layer layer{spec.channelnames[channel], {}};
    layer.values.reserve(pixels.size() / channels);
    for (std::size_t i = channel; i < pixels.size(); i += channels)
      layer.values.push_back(static_cast<double>(pixels[i]) * (bytes ? 255.0 : 1.0));
    image.layers.push_back(std::move(layer));
  }
  return image;
}

}  // namespace fanbeam::core
