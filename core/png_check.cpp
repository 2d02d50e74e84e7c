#include "core/png_check.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <vector>

#include "core/errors.h"

namespace fanbeam::core {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? value >> 1U ^ 0xEDB88320U : value >> 1U;
    table[i] = value;
  }
  return table;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), stream_(path, std::ios::binary) {
    if (!stream_)
      throw_input_error(ErrorClass::io, Place{path.string()}, "", "not readable", "an image file");
  }

  bool begins_as_png() {
    std::array<char, 8> head{};
    stream_.read(head.data(), head.size());
    at_ = stream_.gcount();
    return std::string_view(head.data(), static_cast<std::size_t>(at_)) == kSignature;
  }

  std::uint32_t number() {
    std::array<char, 4> bytes{};
    take(bytes.data(), 4);
    std::uint32_t value = 0;
    for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
    return value;
  }

  void skip(std::uint32_t count) {
    std::array<char, 4096> bytes{};
    for (std::uint32_t left = count; left > 0;) {
      const std::uint32_t part = std::min<std::uint32_t>(left, bytes.size());
      take(bytes.data(), part);
      left -= part;
    }
  }

  void begin_checksum() { crc_ = 0xFFFFFFFFU; }
  std::uint32_t checksum() const { return ~crc_; }

  [[noreturn]] void refuse(const char* found, const char* expected) const {
    Place place{path_.string()};
    place.byte_offset = at_;
    throw_input_error(ErrorClass::parse, place, "PNG", found, expected);
  }

 private:
  void take(char* bytes, std::uint32_t count) {
    static const std::array<std::uint32_t, 256> kTable = make_crc_table();
    stream_.read(bytes, count);
    if (stream_.gcount() != count) refuse("ends here", "a complete file");
    for (std::uint32_t i = 0; i < count; ++i)
      crc_ = kTable[(crc_ ^ static_cast<unsigned char>(bytes[i])) & 0xFFU] ^ crc_ >> 8U;
    at_ += count;
  }

  const std::filesystem::path& path_;
  std::ifstream stream_;
  std::int64_t at_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace

std::optional<ClaimedSize> check_png(const std::filesystem::path& path) {
  constexpr std::uint32_t kHead = 0x49484452U;  // "IHDR"
  constexpr std::uint32_t kEnd = 0x49454E44U;   // "IEND"
  Reader reader(path);
  if (!reader.begins_as_png()) return std::nullopt;
  ClaimedSize size;
  for (bool first = true;; first = false) {
    const std::uint32_t length = reader.number();
    reader.begin_checksum();
    const std::uint32_t type = reader.number();
    if (first != (type == kHead) || (first && length != 13))
      reader.refuse("chunks out of order", "one head, at the beginning");
    if (first) size = {reader.number(), reader.number()};
    reader.skip(first ? length - 8 : length);
    const std::uint32_t checksum = reader.checksum();
    if (reader.number() != checksum) reader.refuse("wrong checksum", "undamaged chunks");
    if (type == kEnd) return size;
  }
}

}  // namespace fanbeam::core
