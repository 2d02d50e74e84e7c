#include "apps/figure/font.h"

namespace fanbeam::apps {
namespace {

constexpr char32_t kUnknownLetter = 0xfffd;

// Bytes of the sequence that `lead` begins; 0 when no sequence does.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  if (lead >= 0xf0 && lead < 0xf5) return 4;
  return 0;
}

// The code point of a sequence; U+FFFD when it is cut off or longer than need be.
char32_t decoded(std::string_view sequence, std::size_t length) {
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (length == 0 || sequence.size() < length) return kUnknownLetter;
  if (length == 1) return static_cast<unsigned char>(sequence[0]);
  char32_t point = static_cast<unsigned char>(sequence[0]) & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(sequence[i]);
    if ((byte & 0xc0U) != 0x80) return kUnknownLetter;
    point = (point << 6U) | (byte & 0x3fU);
  }
  return point < kLeast[length] ? kUnknownLetter : point;
}

}  // namespace

const Glyph& glyph(char32_t code_point, bool bold) {
  constexpr char32_t kAsciiEnd = 0x7f, kLatin1 = 0xa0, kLatin1End = 0x100;
  std::size_t index = U'?' - U' ';
  if (code_point >= U' ' && code_point < kAsciiEnd) index = code_point - U' ';
  if (code_point >= kLatin1 && code_point < kLatin1End)
    index = kAsciiEnd - U' ' + (code_point - kLatin1);
  return (bold ? kBoldGlyphTable : kGlyphTable)[index];
}

std::u32string code_points(std::string_view utf8) {
  std::u32string points;
  while (!utf8.empty()) {
    const std::size_t length = sequence_length(static_cast<unsigned char>(utf8.front()));
    points += decoded(utf8, length);
    utf8.remove_prefix(points.back() == kUnknownLetter ? 1 : length);
  }
  return points;
}

}  // namespace fanbeam::apps
