// Conversions at the borders of the program. Inside everything is SI and radians; names carry the
// unit.
#pragma once

#include "core/constants.h"

namespace fanbeam::core {

inline constexpr double kFoot_m = 0.3048;             // international foot, exact
inline constexpr double kKnot_mps = 1852.0 / 3600.0;  // international knot, exact

constexpr double radians(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double degrees(double angle_rad) { return angle_rad * (180.0 / kPi); }

// Whole millionths of a degree, for texts: an angle of a file in degrees, without the last digits
// that its way through radians leaves. Never -0.
double rounded_degrees(double angle_rad);

// Angle brought into [0, 360) degrees or [-pi, pi) radians; finite input.
double wrap_360_deg(double angle_deg);
double wrap_pi_rad(double angle_rad);

}  // namespace fanbeam::core
