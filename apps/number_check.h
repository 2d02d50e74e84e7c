// Numbers on the command line: within limits, which help and man pages print.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

#include "core/number_range.h"
#include "core/text.h"

namespace fanbeam::apps {

// A number with a decimal point. CLI::Range lets NaN pass, which is neither below nor above
// anything.
inline CLI::Validator number_from(const core::NumberRange& range) {
  const std::string limits = core::to_string(range);
  const auto refuse = [range, limits](const std::string& text) {
    const core::ParsedNumber number = core::parse_number(text);
    const bool good = number.error == core::NumberError::none && range.holds(number.value);
    return good ? std::string() : text + " given, expected a number from " + limits;
  };
  return {refuse, limits};
}
inline CLI::Validator number_from(double least, double most) {
  return number_from(core::NumberRange{least, most});
}

// What an integer option takes, whatever its type: CLI11 alone would read -1 as 2^64 - 1 for an
// unsigned one, anything larger as the largest, and 010 as eight.
inline CLI::Validator whole_number_from(std::uint64_t least, std::uint64_t most) {
  const std::string range = std::to_string(least) + " to " + std::to_string(most);
  const auto refuse = [least, most, range](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool plain = text.size() == 1 || !text.starts_with('0');
    const bool good = error == std::errc() && end == text.data() + text.size() && plain &&
                      value >= least && value <= most;
    return good ? std::string() : text + " given, expected a whole number from " + range;
  };
  return {refuse, range};
}

}  // namespace fanbeam::apps
