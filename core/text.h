// Reading numbers from text without looking at the locale.
#pragma once

#include <optional>
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

}  // namespace fanbeam::core
