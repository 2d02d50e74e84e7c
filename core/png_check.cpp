#include "core/png_check.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "core/errors.h"
#include "core/png_data_private.h"

namespace fanbeam::core {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::uint32_t kHead = 0x49484452U;     // "IHDR"
constexpr std::uint32_t kPalette = 0x504C5445U;  // "PLTE"
constexpr std::uint32_t kData = 0x49444154U;     // "IDAT"
constexpr std::uint32_t kEnd = 0x49454E44U;      // "IEND"

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

  // All of so many bytes, a part at a time.
  void parts(std::uint32_t count, const std::function<void(const char*, std::uint32_t)>& look) {
    std::array<char, 4096> bytes{};
    for (std::uint32_t left = count; left > 0;) {
      const std::uint32_t part = std::min<std::uint32_t>(left, bytes.size());
      take(bytes.data(), part);
      look(bytes.data(), part);
      left -= part;
    }
  }

  void begin_checksum() { crc_ = 0xFFFFFFFFU; }
  void compare_checksum() {
    const std::uint32_t checksum = ~crc_;
    if (number() != checksum) refuse("wrong checksum", "undamaged chunks");
  }

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

// In an order that the library takes without a word.
class ChunkOrder {
 public:
  explicit ChunkOrder(bool with_palette) : with_palette_(with_palette) {}

  bool allows(std::uint32_t type, std::uint32_t length) {
    const bool follows_data = in_data_;
    in_data_ = type == kData;
    if (type == kPalette) {
      if (palette_ || length == 0 || length > 768 || length % 3 != 0) return false;
      return palette_ = true;
    }
    if (type == kData) {
      if (data_ && !follows_data) return false;  // in one piece
      data_ = true;
      return palette_ || !with_palette_;
    }
    // Whoever does not know a chunk must not go on where its first letter is a capital.
    return type == kEnd || (type >> 24U & 0x20U) != 0;
  }

 private:
  bool with_palette_;
  bool palette_ = false, data_ = false, in_data_ = false;
};

bool is_name(std::uint32_t type) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>((type >> shift & 0xFFU) | 0x20U);
    if (letter < 'a' || letter > 'z') return false;
  }
  return true;
}

PngHead read_head(Reader& reader, const std::function<void(const ClaimedSize&)>& accept) {
  if (reader.number() != 13) reader.refuse("no head", "a head of 13 bytes");
  reader.begin_checksum();
  if (reader.number() != kHead) reader.refuse("no head", "a head at the beginning");
  PngHead head;
  head.columns = reader.number();
  head.rows = reader.number();
  for (int* field :
       {&head.bits, &head.colour_type, &head.compression, &head.filter, &head.interlace})
    reader.parts(1, [&](const char* byte, std::uint32_t) {
      *field = static_cast<int>(static_cast<unsigned char>(*byte));
    });
  reader.compare_checksum();
  accept({head.columns, head.rows});
  if (!head.known()) reader.refuse("a kind of picture that there is not", "a PNG picture");
  return head;
}

}  // namespace

bool check_png(const std::filesystem::path& path,
               const std::function<void(const ClaimedSize&)>& accept) {
  Reader reader(path);
  if (!reader.begins_as_png()) return false;
  const PngHead head = read_head(reader, accept);
  PngData data(head);
  ChunkOrder order(head.with_palette());
  for (std::uint32_t type = 0; type != kEnd;) {
    const std::uint32_t length = reader.number();
    reader.begin_checksum();
    type = reader.number();
    if (!is_name(type) || !order.allows(type, length))
      reader.refuse("chunks out of order",
                    "a palette where there is one, the picture data in one piece, the end");
    bool sound = true;
    reader.parts(length, [&](const char* bytes, std::uint32_t count) {
      if (type == kData && sound) sound = data.take(bytes, count);
    });
    reader.compare_checksum();
    if (!sound) reader.refuse("damaged picture data", "what the head promises, deflated");
  }
  if (!data.complete()) reader.refuse("too little picture data", "as many rows as the head says");
  return true;
}

}  // namespace fanbeam::core
