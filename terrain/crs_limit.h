// Which coordinates GDAL's conversions between reference systems are given.
#pragma once

#include <cmath>

namespace fanbeam::terrain {

// Beyond every easting, zone prefixes included. GDAL brings web Mercator's eastings into one turn
// by subtracting turns one by one: 1e300 never ends. No numbers are refused as well.
inline bool is_convertible(double x, double y) {
  constexpr double kLargest = 1e8;
  return std::abs(x) <= kLargest && std::abs(y) <= kLargest;
}

}  // namespace fanbeam::terrain
