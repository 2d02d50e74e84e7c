#include "scenes/airport/airport_numbers.h"

#include <cmath>

#include "core/text.h"

namespace fanbeam::scenes {

using core::ErrorClass;

std::optional<double> airport_number(std::string_view text, const std::string& field,
                                     const core::NumberRange& range, const char* unit,
                                     const core::Place& place, core::ProblemList& problems) {
  const core::ParsedNumber number = core::parse_number(text);
  const std::string value = "\"" + std::string(text.substr(0, 40)) + "\"";
  const std::string expected = core::to_string(range) + (*unit == '\0' ? "" : " ") + unit;
  if (number.error == core::NumberError::nonfinite) {
    problems.error(ErrorClass::nonfinite, place, field, value, expected);
  } else if (number.error != core::NumberError::none) {
    problems.error(ErrorClass::parse, place, field, value, "a number, " + expected);
  } else if (number.value < range.low || number.value > range.high) {
    problems.error(ErrorClass::range, place, field, value, expected);
  } else {
    return number.value;
  }
  return std::nullopt;
}

std::optional<int> airport_code(std::string_view text, const std::string& field, int least,
                                int most, const core::Place& place, core::ProblemList& problems) {
  const std::optional<double> value =
      airport_number(text, field, {double(least), double(most)}, "", place, problems);
  if (!value) return std::nullopt;
  if (*value == std::floor(*value)) return static_cast<int>(*value);
  problems.error(ErrorClass::range, place, field, std::string(text.substr(0, 40)),
                 "a whole number");
  return std::nullopt;
}

}  // namespace fanbeam::scenes
