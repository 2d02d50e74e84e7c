#include "core/exr_check.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::core {
namespace {

constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";
constexpr std::uint32_t kManyParts = 0x1000;
constexpr std::size_t kLongestName = 255;

class ExrHead {
 public:
  explicit ExrHead(const std::filesystem::path& path)
      : path_(path), stream_(path, std::ios::binary | std::ios::ate) {
    if (!stream_)
      throw_input_error(ErrorClass::io, Place{path.string()}, "", "not readable", "an image file");
    size_ = stream_.tellg();
    stream_.seekg(0);
  }

  bool begins_as_exr() {
    std::array<char, 4> magic{};
    stream_.read(magic.data(), magic.size());
    at_ = stream_.gcount();
    return std::string_view(magic.data(), static_cast<std::size_t>(at_)) == kExrMagic;
  }

  std::int64_t left() const { return size_ - at_; }

  std::uint32_t number() {
    std::array<unsigned char, 4> bytes{};
    stream_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    if (stream_.gcount() != 4) refuse("ends here", "a complete file");
    at_ += 4;
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{bytes[i]} << 8U * i;
    return value;
  }
  std::int64_t signed_number() { return static_cast<std::int32_t>(number()); }

  // Up to its zero byte; empty where that comes first.
  std::string name() {
    std::string text;
    for (char letter = 1; letter != 0; ++at_) {
      if (!stream_.get(letter)) refuse("ends here", "a complete file");
      if (letter != 0) text += letter;
      if (text.size() > kLongestName) refuse("a longer name", "names of at most 255 bytes");
    }
    return text;
  }

  void skip(std::int64_t bytes) {
    at_ += bytes;
    stream_.seekg(at_);
  }

  // A length that stands in front of so many bytes.
  std::int64_t length(std::int64_t most) {
    const std::int64_t bytes = signed_number();
    if (bytes < 0 || bytes > most)
      refuse(std::to_string(bytes) + " bytes",
             "a length of at most the " + std::to_string(most) + " bytes that follow");
    return bytes;
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    Place place{path_.string()};
    place.byte_offset = at_;
    throw_input_error(ErrorClass::parse, place, "OpenEXR head", found, expected);
  }

 private:
  const std::filesystem::path& path_;
  std::ifstream stream_;
  std::int64_t size_ = 0, at_ = 0;
};

void check_value(ExrHead& head, const std::string& name, const std::string& type,
                 std::int64_t bytes, const std::function<void(const ClaimedSize&)>& accept) {
  const std::int64_t end = head.left() - bytes;
  if (type == "stringvector") {
    while (head.left() > end) head.skip(head.length(head.left() - end - 4));
  } else if (type == "preview" && bytes >= 8) {
    const std::int64_t columns = head.number(), rows = head.number();
    if (columns > bytes || rows > bytes || (bytes - 8) % 4 != 0 ||
        columns * rows != (bytes - 8) / 4)
      head.refuse(std::to_string(columns) + " x " + std::to_string(rows),
                  "a preview of its length");
  } else if (name == "dataWindow" && type == "box2i" && bytes == 16) {
    const std::int64_t left = head.signed_number(), top = head.signed_number();
    const std::int64_t right = head.signed_number(), bottom = head.signed_number();
    accept({right - left + 1, bottom - top + 1});
  }
  head.skip(head.left() - end);
}

// False at the end of the part.
bool check_attribute(ExrHead& head, const std::function<void(const ClaimedSize&)>& accept) {
  const std::string name = head.name();
  if (name.empty()) return false;
  const std::string type = head.name();
  const std::int64_t bytes = head.length(head.left() - 4);
  check_value(head, name, type, bytes, accept);
  return true;
}

}  // namespace

bool check_exr(const std::filesystem::path& path,
               const std::function<void(const ClaimedSize&)>& accept) {
  ExrHead head(path);
  if (!head.begins_as_exr()) return false;
  const bool many_parts = (head.number() & kManyParts) != 0;
  while (check_attribute(head, accept)) {
    // An empty part ends a file of many parts.
    while (check_attribute(head, accept)) {
    }
    if (!many_parts) break;
  }
  return true;
}

}  // namespace fanbeam::core
