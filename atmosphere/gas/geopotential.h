// The constants of Recommendation ITU-R P.835-6 that any column of air needs.
#pragma once

namespace fanbeam::atmosphere {

inline constexpr double kLapse_K_per_km = 6.5;
inline constexpr double kTropopause_km = 11.0;
inline constexpr double kHydrostatic_K_per_km = 34.1632;  // g M / R
inline constexpr double kVapourScaleHeight_m = 2000.0;
inline constexpr double kZeroCelsius_K = 273.15;

// h' = 6356.766 h / (6356.766 + h) km.
inline double geopotential_km(double height_m) {
  const double h = height_m * 1e-3;
  return 6356.766 * h / (6356.766 + h);
}

}  // namespace fanbeam::atmosphere
