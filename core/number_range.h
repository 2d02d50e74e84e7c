// Ranges of allowed numbers, and the one check that refuses what lies outside: the same words for a
// key of a file, a field of a caller's struct and an argument.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::core {

// Closed interval of allowed values, or with `above_low` the half-open (low, high].
struct NumberRange {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool above_low = false;

  // False for NaN.
  bool holds(double value) const {
    return value >= low && value <= high && !(above_low && value == low);
  }
};

// "1 to 10", "at least 1", "above 1, at most 10".
std::string to_string(const NumberRange& range);

// Adds E-NONFINITE or E-RANGE with the range, and the unit behind it, when `value` lies outside.
void check_range(ProblemList& problems, std::string_view field, double value,
                 const NumberRange& range, std::string_view unit = {});
// The same for a single input: throws InputError.
void require_range(std::string_view field, double value, const NumberRange& range,
                   std::string_view unit = {});

}  // namespace fanbeam::core
