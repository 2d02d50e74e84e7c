// Refusals that the sources of this folder share. NaN passes none of the checks.
#pragma once

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::signal {

[[noreturn]] inline void refuse(const char* field, double value, std::string expected) {
  core::throw_input_error(core::ErrorClass::range, field, value, std::move(expected));
}

inline void check_positive(const char* field, double value) {
  core::require_range(field, value, {.low = 0.0, .above_low = true});
}

inline void check_not_negative(const char* field, double value) {
  core::require_range(field, value, {.low = 0.0});
}

inline void check_count(const char* field, double count, int least, int most) {
  core::require_range(field, count, {static_cast<double>(least), static_cast<double>(most)});
}

inline void check_finite(const char* field, const std::vector<std::complex<double>>& values) {
  for (const std::complex<double>& value : values)
    if (!std::isfinite(std::norm(value)))
      core::throw_input_error(core::ErrorClass::nonfinite, field, std::norm(value), "finite");
}

}  // namespace fanbeam::signal
