#include "core/text.h"

#include <charconv>
#include <cmath>

namespace fanbeam::core {

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
