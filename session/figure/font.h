// The letters of pictures: bitmap fonts that ship with the program, so that a text has the same pixels
// on every machine. Fixed width; ASCII and Latin-1; regular and bold.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace fanbeam::session {

inline constexpr int kGlyphColumns = 7;  // the gap to the next letter included
inline constexpr int kGlyphRows = 13;    // two of them below the base line
inline constexpr int kGlyphs = 191;

// Rows from the top; the highest bit is the leftmost pixel.
using Glyph = std::array<std::uint8_t, kGlyphRows>;
extern const std::array<Glyph, kGlyphs> kGlyphTable, kBoldGlyphTable;

// Of a code point; what the font lacks, control characters too, is a question mark.
const Glyph& glyph(char32_t code_point, bool bold);

// Code points of UTF-8. Bytes that are no UTF-8 become U+FFFD, one each.
std::u32string code_points(std::string_view utf8);

}  // namespace fanbeam::session
