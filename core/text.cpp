#include "core/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace fanbeam::core {
namespace {

bool may_be_shown(const Character& character) {
  const std::uint32_t code = character.code;
  return character.valid && code >= 0x20 && !(code >= 0x7F && code < 0xA0) && code != 0x2028 &&
         code != 0x2029 && !(code >= 0x202A && code <= 0x202E) &&
         !(code >= 0x2066 && code <= 0x2069);
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

constexpr std::size_t kLongestWord = 64;

}  // namespace

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || bytes > text.size()) return {first, 1, false};
  std::uint32_t code = first & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {first, 1, false};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast.at(bytes) || code > 0x10FFFF || surrogate) return {first, 1, false};
  return {code, bytes, true};
}

std::string printable_text(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    if (may_be_shown(character)) {
      shown += text.substr(0, character.bytes);
    } else {
      std::array<char, 16> escape{};
      std::snprintf(escape.data(), escape.size(), character.code > 0xFF ? "\\u%04x" : "\\x%02x",
                    character.code);
      shown += escape.data();
    }
    text.remove_prefix(character.bytes);
  }
  return shown;
}

bool is_printable_text(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!may_be_shown(character)) return false;
    text.remove_prefix(character.bytes);
  }
  return true;
}

bool is_safe_word(std::string_view text) {
  return !text.empty() && text.size() <= kLongestWord && is_plain(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_plain(c) || c == '.' || c == '-' || c == '_'; });
}

std::string safe_word(std::string_view text) {
  std::string word;
  for (const char c : text)
    if (word.size() < kLongestWord && (!word.empty() || is_plain(c)))
      word += is_plain(c) || c == '.' || c == '-' || c == '_' ? c : '-';
  return word.empty() ? "unnamed" : word;
}

std::string shell_word(std::string_view text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return is_plain(c) || c == '.' || c == '/' || c == '_' || c == '-';
  });
  if (plain && !text.empty()) return std::string(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

ParsedNumber parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return {0.0, NumberError::not_a_number};
  }
  ParsedNumber parsed;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), parsed.value);
  if (status == std::errc::invalid_argument || end != text.data() + text.size()) {
    parsed.error = NumberError::not_a_number;
  } else if (status == std::errc::result_out_of_range) {
    parsed.error = NumberError::out_of_range;
  } else if (!std::isfinite(parsed.value)) {
    parsed.error = NumberError::nonfinite;
  }
  if (parsed.error != NumberError::none) parsed.value = 0.0;
  return parsed;
}

}  // namespace fanbeam::core
