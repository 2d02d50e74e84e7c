#include "core/units.h"

#include <cmath>

namespace fanbeam::core {

double rounded_degrees(double angle_rad) {
  return std::round(degrees(angle_rad) * 1e6) / 1e6 + 0.0;
}

double wrap_360_deg(double angle_deg) {
  const double wrapped = angle_deg - 360.0 * std::floor(angle_deg / 360.0);
  return wrapped >= 360.0 ? 0.0 : wrapped;  // -1e-17 would round up to 360
}

double wrap_pi_rad(double angle_rad) {
  const double wrapped = angle_rad - 2.0 * kPi * std::floor((angle_rad + kPi) / (2.0 * kPi));
  return wrapped >= kPi ? wrapped - 2.0 * kPi : wrapped;
}

}  // namespace fanbeam::core
