// Range checks shared by the models of this folder.
#pragma once

#include <cmath>

#include "core/errors.h"

namespace fanbeam::materials {

// Throws InputError: E-NONFINITE for NaN or infinity, E-RANGE outside [low, high].
inline void require_range(const char* field, double value, double low, double high) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  const std::string expected = core::number_text(low) + " to " + core::number_text(high);
  core::throw_input_error(
      std::isfinite(value) ? core::ErrorClass::range : core::ErrorClass::nonfinite, field, value,
      expected);
}

}  // namespace fanbeam::materials
