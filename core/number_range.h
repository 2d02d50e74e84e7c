// Ranges of allowed numbers, and the one check that refuses what lies outside: the same words for a
// key of a file, a field of a caller's struct and an argument.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::core {

// Closed interval of allowed values, or with `above_low` the half-open (low, high]; with `or_zero`
// also 0, which then stands for a default.
struct NumberRange {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool above_low = false;
  bool or_zero = false;

  // False for NaN.
  bool holds(double value) const {
    if (or_zero && value == 0.0) return true;
    return value >= low && value <= high && !(above_low && value == low);
  }
};

// "0.1 to 1e7", "at least 1", "above 1, at most 10", "0, or 0.3 to 10000".
std::string to_string(const NumberRange& range);

// Adds E-NONFINITE or E-RANGE with the range, and the unit behind it, when `value` lies outside; of a
// value with more than 15 digits twelve are told, where these lie outside too.
void check_range(ProblemList& problems, std::string_view field, double value,
                 const NumberRange& range, std::string_view unit = {});
// The same for a single input: throws InputError.
void require_range(std::string_view field, double value, const NumberRange& range,
                   std::string_view unit = {});

}  // namespace fanbeam::core
