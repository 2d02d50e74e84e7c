// Precipitation over height: rain, the melting layer on top of it, and dry snow above.
//
// Wet snow and melting flakes attenuate more than the rain they become. Recommendation ITU-R
// P.530-17, section 2.4.3 (combined rain and wet snow), gives the specific attenuation as a
// multiple of that of the rain below, over the height d in m above the rain height, which is the
// 0 C level plus 360 m:
//   0                                                                   d > 0
//   4 g^2 / (1 + (1 - exp(-(d/600)^2))^2 (4 g^2 - 1)), g = 1 - exp(d/70)   -1200 <= d <= 0
//   1                                                                   d < -1200
// The largest multiple is 3.53, 241 m under the rain height. At 36 GHz and 10 to 15 mm/h wet
// snow of 8 to 13 dB/km was measured (Jain and Watson 1985), 2.8 to 3.2 times rain: consistent.
// Confidence: the formula is quoted from memory of the Recommendation; its shape is supported by
// that measurement. The step of 3 % at d = -1200 m is the Recommendation's own.
//
// The echo of the bright band follows the same multiple. That is a plain assumption of low
// confidence: at centimetre wavelengths bright bands stand 5 to 8 dB over the rain, at 35 GHz 0 to
// 5 dB were observed; the multiple is 5.5 dB at its peak.
#pragma once

namespace fanbeam::atmosphere {

inline constexpr double kRainHeightAboveZeroC_m = 360.0;
inline constexpr double kMeltingDepth_m = 1200.0;

// What melting makes of the rain `above_rain_height_m` over (negative: under) the rain height.
double melting_multiple(double above_rain_height_m) noexcept;

// Upper bound of melting_multiple between two heights over the rain height.
double largest_melting_multiple(double lowest_m, double highest_m) noexcept;

// Heights above the scene's origin. Rain below its top, multiplied by `rain_multiple`; dry snow
// from its base up to its top.
struct PrecipitationLayers {
  double rain_top_m = 0.0;
  bool melting = false;  // the rain's top is the rain height
  double snow_base_m = 0.0, snow_top_m = 0.0;

  // 0 at the top of the rain and above it.
  double rain_multiple(double height_m) const noexcept {
    if (height_m >= rain_top_m) return 0.0;
    return melting ? melting_multiple(height_m - rain_top_m) : 1.0;
  }
  bool has_snow_at(double height_m) const noexcept {
    return height_m >= snow_base_m && height_m < snow_top_m;
  }
};

}  // namespace fanbeam::atmosphere
