#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "core/codec/image_codec_private.h"

namespace fanbeam::core {
namespace {

class OpenFile final : public ImageFile {
 public:
  explicit OpenFile(std::unique_ptr<OIIO::ImageInput> input) : input_(std::move(input)) {}

  int columns() const override { return input_->spec().width; }
  int rows() const override { return input_->spec().height; }
  int channels() const override { return input_->spec().nchannels; }
  std::vector<std::string> channel_names() const override { return input_->spec().channelnames; }
  Depth depth() const override {
    const OIIO::TypeDesc format = input_->spec().format;
    if (format == OIIO::TypeDesc::UINT8) return Depth::bits_8;
    return format == OIIO::TypeDesc::UINT16 ? Depth::bits_16 : Depth::other;
  }
  std::vector<std::pair<std::string, std::string>> texts() const override {
    std::vector<std::pair<std::string, std::string>> found;
    for (const OIIO::ParamValue& attribute : input_->spec().extra_attribs)
      if (attribute.type() == OIIO::TypeDesc::STRING)
        found.emplace_back(attribute.name().string(), attribute.get_string());
    return found;
  }
  bool read(float* pixels, std::string& fault) override {
    if (input_->read_image(0, 0, 0, channels(), OIIO::TypeDesc::FLOAT, pixels)) return true;
    fault = input_->geterror();
    return false;
  }

 private:
  std::unique_ptr<OIIO::ImageInput> input_;
};

class Codec final : public ImageCodec {
 public:
  std::string encode(const PixelsToEncode& pixels, std::string& fault) const override {
    const OIIO::TypeDesc type =
        pixels.floats != nullptr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(pixels.columns, pixels.rows, pixels.channels, type);
    if (!pixels.channel_names.empty()) spec.channelnames = pixels.channel_names;
    if (pixels.name.ends_with(".png"))
      spec.attribute("png:compressionLevel", 2);  // writing must not hold up rendering
    for (const auto& [name, value] : pixels.texts) spec.attribute(name, value);
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(pixels.name.substr(pixels.name.rfind('.') + 1));
    if (!output) {
      fault = OIIO::geterror();
      return {};
    }
    const void* values = pixels.bytes;
    if (pixels.floats != nullptr) values = pixels.floats;
    OIIO::Filesystem::IOVecOutput bytes;
    if (!output->set_ioproxy(&bytes) || !output->open(pixels.name, spec) ||
        !output->write_image(type, values) || !output->close()) {
      fault = output->geterror();
      return {};
    }
    const std::vector<unsigned char>& buffer = bytes.buffer();
    return {reinterpret_cast<const char*>(buffer.data()), buffer.size()};
  }

  // Of one format: else every plugin there is would try a file that is none of its own.
  std::unique_ptr<ImageFile> open(const std::string& path, const std::string& format,
                                  std::string& fault) const override {
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec)) {
      fault = input ? input->geterror() : OIIO::geterror();
      return nullptr;
    }
    return std::make_unique<OpenFile>(std::move(input));
  }
};

}  // namespace
}  // namespace fanbeam::core

const fanbeam::core::ImageCodec* fanbeam_image_codec_2() {
  static const fanbeam::core::Codec codec;
  return &codec;
}
