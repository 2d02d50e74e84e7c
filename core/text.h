// Text from outside: numbers read without looking at the locale, words that are safe as names of
// folders, what may be printed, and what a shell takes back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fanbeam::core {

enum class NumberError { none, not_a_number, out_of_range, nonfinite };

struct ParsedNumber {
  double value = 0.0;
  NumberError error = NumberError::none;
};

// The whole of `text` (blanks around it allowed) as a decimal number with a point. "nan" and "inf"
// are `nonfinite`, "1e400" is `out_of_range`, "1,5" and "" are `not_a_number`.
ParsedNumber parse_number(std::string_view text);

std::string_view trimmed(std::string_view text);

struct Character {
  std::uint32_t code = 0;  // of Unicode, or the byte that is none
  std::size_t bytes = 1;
  bool valid = false;
};
// The first character of a text that is not empty; one byte where it is no UTF-8 (RFC 3629).
Character first_character(std::string_view text);

// `text` as a terminal, a log or a page may show it: control characters (C0, DEL, C1), the ones that
// turn the direction of writing (U+202A to U+202E, U+2066 to U+2069), line separators and bytes that
// are no UTF-8 become \x1b or \u202e; everything else stays. Files may hold anything, and a
// terminal obeys it.
std::string printable_text(std::string_view text);
bool is_printable_text(std::string_view text);

// 1 to 64 letters, digits, '.', '-' and '_' of ASCII, the first a letter or digit: the name of one
// file or folder on any system, never a path, an option or a hidden file.
bool is_safe_word(std::string_view text);
// Such a word from any text: other bytes become '-', what is too long is cut; "unnamed" where
// nothing is left.
std::string safe_word(std::string_view text);

// A word that a POSIX shell takes back as this text, whatever it holds: letters, digits, '.', '/',
// '_' and '-' of ASCII stand as they are, anything else in quotation marks.
std::string shell_word(std::string_view text);

}  // namespace fanbeam::core
