// Elementary functions as series without branches and calls, so that loops over arrays become
// vector code. Each states its range and error; elsewhere the standard library is the better choice.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace fanbeam::core {

// Cosine and sine of an angle up to pi/2 either way. Absolute error 1e-9, below 1e-15 to 0.3 rad.
inline void series_cosine_sine(double x, double& cosine, double& sine) noexcept {
  constexpr double k2 = 1.0 / 2, k3 = 1.0 / 6, k4 = 1.0 / 12, k5 = 1.0 / 20, k6 = 1.0 / 30,
                   k7 = 1.0 / 42, k8 = 1.0 / 56, k9 = 1.0 / 72, k10 = 1.0 / 90, k11 = 1.0 / 110,
                   k12 = 1.0 / 132, k13 = 1.0 / 156, k14 = 1.0 / 182;
  const double y = x * x;
  double c = 1.0 - y * k14;
  c = 1.0 - y * k12 * c;
  c = 1.0 - y * k10 * c;
  c = 1.0 - y * k8 * c;
  c = 1.0 - y * k6 * c;
  c = 1.0 - y * k4 * c;
  cosine = 1.0 - y * k2 * c;
  double s = 1.0 - y * k13;
  s = 1.0 - y * k11 * s;
  s = 1.0 - y * k9 * s;
  s = 1.0 - y * k7 * s;
  s = 1.0 - y * k5 * s;
  sine = x * (1.0 - y * k3 * s);
}

// Angle of the point (x, y) for x >= 0, -pi/2 to pi/2; 0 at the origin. Absolute error 2e-10, below
// 1e-15 within 0.45 rad of an axis.
inline double series_arctangent(double y, double x) noexcept {
  constexpr double kQuarterTurn = 3.14159265358979323846 / 2;
  const double height = std::abs(y);
  const bool steep = height > x;
  const double tangent = (steep ? x : height) / std::max(steep ? height : x, 1e-300);
  const double t = tangent / (1.0 + std::sqrt(1.0 + tangent * tangent));  // of half the angle
  const double z = t * t;
  double series = 1.0 / 21;
  series = 1.0 / 19 - z * series;
  series = 1.0 / 17 - z * series;
  series = 1.0 / 15 - z * series;
  series = 1.0 / 13 - z * series;
  series = 1.0 / 11 - z * series;
  series = 1.0 / 9 - z * series;
  series = 1.0 / 7 - z * series;
  series = 1.0 / 5 - z * series;
  series = 1.0 / 3 - z * series;
  const double small = 2.0 * t * (1.0 - z * series);
  return std::copysign(steep ? kQuarterTurn - small : small, y);
}

// Arcsine of 0 to 1; 0 of 0. Absolute error 3e-8. Abramowitz & Stegun, Handbook of Mathematical Functions,
// 1964, 4.4.46.
inline double series_arcsine(double x) noexcept {
  constexpr double kQuarterTurn = 3.14159265358979323846 / 2;
  double series = -0.0012624911;
  series = 0.0066700901 + x * series;
  series = -0.0170881256 + x * series;
  series = 0.0308918810 + x * series;
  series = -0.0501743046 + x * series;
  series = 0.0889789874 + x * series;
  series = -0.2145988016 + x * series;
  series = 1.5707963050 + x * series;
  const double angle_rad = kQuarterTurn - std::sqrt(1.0 - x) * series;
  return x > 0.0 ? angle_rad : 0.0;
}

// exp(-x) for x from 0 up; held from 700 on, where it is 1e-304. Relative error 3e-10, exact at 0.
inline double series_decay(double x) noexcept {
  constexpr double kPerLn2 = 1.44269504088896340736, kLn2 = 0.69314718055994530942;
  constexpr double kRound = 0x1.8p52;  // a sum with it ends in the nearest whole number
  constexpr double k2 = 1.0 / 2, k3 = 1.0 / 3, k4 = 1.0 / 4, k5 = 1.0 / 5, k6 = 1.0 / 6,
                   k7 = 1.0 / 7, k8 = 1.0 / 8;
  const double limited = std::min(700.0, x);
  const double rounded = limited * kPerLn2 + kRound;
  const double r = limited - (rounded - kRound) * kLn2;
  double series = 1.0 - r * k8;
  series = 1.0 - r * k7 * series;
  series = 1.0 - r * k6 * series;
  series = 1.0 - r * k5 * series;
  series = 1.0 - r * k4 * series;
  series = 1.0 - r * k3 * series;
  series = 1.0 - r * k2 * series;
  series = 1.0 - r * series;
  const std::uint64_t halvings = std::bit_cast<std::uint64_t>(rounded) << 52;
  return series * std::bit_cast<double>((std::uint64_t{1023} << 52) - halvings);
}

// Natural logarithm of a normal number above 0: relative error 1e-15. For 0 and denormal numbers
// it is below -708, for infinity above 709; it means nothing for negative numbers and NaN.
inline double series_log(double x) noexcept {
  constexpr double kLn2 = 0.69314718055994530942;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  constexpr std::uint64_t kOne = std::uint64_t{1023} << 52;
  // Split so that the mantissa lies between 1/sqrt(2) and sqrt(2).
  constexpr std::uint64_t kShift = 0x0009'5F61'9980'C433;  // from sqrt(1/2) to the next power of 2
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + kShift;
  constexpr std::uint64_t kWholeNumber = 0x4330'0000'0000'0000;  // 2^52, and n in its last bits
  const double exponent = std::bit_cast<double>(kWholeNumber | (bits >> 52)) - (0x1p52 + 1023.0);
  const auto mantissa = std::bit_cast<double>((bits & kMantissa) + kOne - kShift);
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double z = s * s;
  double series = 1.0 / 21;
  series = 1.0 / 19 + z * series;
  series = 1.0 / 17 + z * series;
  series = 1.0 / 15 + z * series;
  series = 1.0 / 13 + z * series;
  series = 1.0 / 11 + z * series;
  series = 1.0 / 9 + z * series;
  series = 1.0 / 7 + z * series;
  series = 1.0 / 5 + z * series;
  series = 1.0 / 3 + z * series;
  return exponent * kLn2 + 2.0 * s * (1.0 + z * series);
}

}  // namespace fanbeam::core
