#include "session/figure/font.h"

#include "core/text.h"

namespace fanbeam::session {
const Glyph& glyph(char32_t code_point, bool bold) {
  constexpr char32_t kAsciiEnd = 0x7f, kLatin1 = 0xa0, kLatin1End = 0x100;
  std::size_t index = U'?' - U' ';
  if (code_point >= U' ' && code_point < kAsciiEnd) index = code_point - U' ';
  if (code_point >= kLatin1 && code_point < kLatin1End)
    index = kAsciiEnd - U' ' + (code_point - kLatin1);
  return (bold ? kBoldGlyphTable : kGlyphTable)[index];
}

std::u32string code_points(std::string_view utf8) {
  constexpr char32_t kUnknownLetter = 0xfffd;
  std::u32string points;
  while (!utf8.empty()) {
    const core::Character character = core::first_character(utf8);
    points += character.valid ? static_cast<char32_t>(character.code) : kUnknownLetter;
    utf8.remove_prefix(character.bytes);
  }
  return points;
}

}  // namespace fanbeam::session
