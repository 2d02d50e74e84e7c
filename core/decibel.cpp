#include "core/decibel.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace fanbeam::core {

double power_from_dB(double level_dB) {
  if (!std::isfinite(level_dB))
    throw_input_error(ErrorClass::nonfinite, "level_dB", level_dB, "a finite level");
  if (std::abs(level_dB) > kLargestLevel_dB)
    throw_input_error(ErrorClass::range, "level_dB", level_dB, "-3000 to 3000 dB");
  return std::pow(10.0, level_dB / 10.0);
}

double dB_from_power(double power, double floor_dB) {
  if (!std::isfinite(power))
    throw_input_error(ErrorClass::nonfinite, "power", power, "a finite power");
  if (power < 0.0) throw_input_error(ErrorClass::range, "power", power, "0 or more");
  if (power == 0.0) return floor_dB;
  return std::max(10.0 * std::log10(power), floor_dB);
}

}  // namespace fanbeam::core
