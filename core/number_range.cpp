#include "core/number_range.h"

#include <array>
#include <charconv>
#include <cmath>

namespace fanbeam::core {
namespace {

// As people write it: 1e7, not 1e+07.
std::string limit_text(double end) {
  std::string text = number_text(end);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const bool negative = text[exponent + 1] == '-';
  const std::size_t digits = text.find_first_not_of("+-0", exponent + 1);
  return text.replace(exponent + 1, digits - exponent - 1, negative ? "-" : "");
}

double to_digits(double value, int digits) {
  std::array<char, 64> text{};
  char* const end = std::to_chars(text.data(), text.data() + text.size(), value,
                                  std::chars_format::general, digits)
                        .ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

// As it was written: what takes more digits than anybody writes went through arithmetic, -50 C through kelvin.
std::string told_text(double value, const NumberRange& range) {
  constexpr int kWritten = 15, kSure = 12;
  if (!std::isfinite(value) || to_digits(value, kWritten) == value) return number_text(value);
  const double sure = to_digits(value, kSure);
  return number_text(range.holds(sure) ? value : sure);
}

}  // namespace

std::string to_string(const NumberRange& range) {
  const bool has_low = range.low > -std::numeric_limits<double>::max();
  const bool has_high = range.high < std::numeric_limits<double>::max();
  if (!has_low && !has_high) return "a finite number";
  const std::string low = limit_text(range.low), high = limit_text(range.high);
  if (range.above_low) return ("above " + low).append(has_high ? ", at most " + high : "");
  if (!has_high) return "at least " + low;
  if (!has_low) return "at most " + high;
  return std::string(range.or_zero ? "0, or " : "").append(low).append(" to ").append(high);
}

void check_range(ProblemList& problems, std::string_view field, double value,
                 const NumberRange& range, std::string_view unit) {
  if (range.holds(value)) return;
  std::string expected = to_string(range);
  if (!unit.empty()) expected.append(" ").append(unit);
  problems.error(std::isfinite(value) ? ErrorClass::range : ErrorClass::nonfinite, {},
                 std::string(field), told_text(value, range), std::move(expected));
}

void require_range(std::string_view field, double value, const NumberRange& range,
                   std::string_view unit) {
  if (range.holds(value)) return;
  ProblemList problems;
  check_range(problems, field, value, range, unit);
  problems.throw_if_errors();
}

}  // namespace fanbeam::core
