#include "terrain/gltf/gltf_container.h"

#include <cstdint>
#include <string>

#include "core/errors.h"
#include "core/json_size.h"
#include "terrain/gltf/gltf_limits.h"

namespace fanbeam::terrain {
namespace {

using core::ErrorClass;

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeader_bytes = 12;
constexpr std::size_t kChunkHeader_bytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN" and a zero byte

std::uint32_t little_endian_word(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
  return word;
}

class GlbReader {
 public:
  GlbReader(std::string_view bytes, const std::filesystem::path& file)
      : bytes_(bytes), file_(file.string()) {}

  GltfContainer read() {
    check_header();
    for (std::size_t offset = kHeader_bytes; offset < bytes_.size();) offset = read_chunk(offset);
    if (chunks_ == 0) refuse(kHeader_bytes, "chunks", "none", "a JSON chunk");
    return container_;
  }

 private:
  [[noreturn]] void refuse(std::size_t offset, std::string field, std::string value,
                           std::string expected) const {
    core::throw_input_error(ErrorClass::parse,
                            core::Place{file_, 0, 0, static_cast<std::int64_t>(offset)},
                            "GLB " + std::move(field), std::move(value), std::move(expected));
  }

  void check_header() const {
    if (bytes_.size() < kHeader_bytes)
      refuse(0, "header", std::to_string(bytes_.size()) + " bytes", "12 bytes");
    if (bytes_.substr(0, 4) != kMagic) refuse(0, "magic", "other bytes", "\"glTF\"");
    const std::uint32_t version = little_endian_word(bytes_, 4);
    if (version != 2)
      core::throw_input_error(ErrorClass::unsupported, core::Place{file_, 0, 0, 4}, "GLB version",
                              std::to_string(version), "2");
    const std::uint32_t length_bytes = little_endian_word(bytes_, 8);
    if (length_bytes != bytes_.size())
      refuse(8, "length", std::to_string(length_bytes),
             "the file's size, " + std::to_string(bytes_.size()) + " bytes");
  }

  // Returns where the next chunk begins.
  std::size_t read_chunk(std::size_t offset) {
    const std::size_t left = bytes_.size() - offset;
    if (left < kChunkHeader_bytes)
      refuse(offset, "chunk header", std::to_string(left) + " bytes", "8 bytes");
    const std::size_t length = little_endian_word(bytes_, offset);
    const std::uint32_t type = little_endian_word(bytes_, offset + 4);
    if (length > left - kChunkHeader_bytes)
      refuse(offset, "chunk length", std::to_string(length),
             "at most " + std::to_string(left - kChunkHeader_bytes) + " bytes");
    if (length % 4 != 0) refuse(offset, "chunk length", std::to_string(length), "a multiple of 4");
    place_chunk(type, offset, length);
    ++chunks_;
    return offset + kChunkHeader_bytes + length;
  }

  void place_chunk(std::uint32_t type, std::size_t offset, std::size_t length) {
    const std::size_t begin = offset + kChunkHeader_bytes;
    if ((chunks_ == 0) != (type == kJsonChunk))
      refuse(offset, "chunk " + std::to_string(chunks_), "type " + std::to_string(type),
             "the one JSON chunk first");
    if (type == kJsonChunk) {
      if (length == 0) refuse(offset, "JSON chunk", "0 bytes", "a JSON text");
      container_ = GltfContainer{bytes_.substr(begin, length), begin, {}, true};
    } else if (type == kBinaryChunk) {
      if (chunks_ != 1)
        refuse(offset, "BIN chunk", "chunk " + std::to_string(chunks_), "it to be chunk 1");
      container_.binary = bytes_.substr(begin, length);
    }
  }

  std::string_view bytes_;
  std::string file_;
  GltfContainer container_;
  std::size_t chunks_ = 0;
};

}  // namespace

GltfContainer open_gltf_container(std::string_view bytes, const std::filesystem::path& file) {
  const bool is_glb = bytes.substr(0, kMagic.size()) == kMagic || file.extension() == ".glb";
  if (is_glb) return GlbReader(bytes, file).read();
  return GltfContainer{bytes, 0, {}, false};
}

void check_json_size(const GltfContainer& container, const std::filesystem::path& file) {
  const auto excess = core::json_excess(container.json, {kDeepestGltfJson, kMostGltfJsonValues});
  if (!excess) return;
  const bool deep = excess->of == core::JsonExcess::Of::levels;
  const std::string most =
      std::to_string(deep ? static_cast<std::size_t>(kDeepestGltfJson) : kMostGltfJsonValues);
  const auto offset = static_cast<std::int64_t>(container.json_offset + excess->offset);
  core::throw_input_error(ErrorClass::limit, core::Place{file.string(), 0, 0, offset},
                          deep ? "JSON nesting" : "JSON values", "more than " + most,
                          "at most " + most);
}

}  // namespace fanbeam::terrain
