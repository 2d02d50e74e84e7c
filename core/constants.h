// Physical constants, SI. Exact values of the SI (BIPM SI brochure, 9th edition, 2019) where the SI
// fixes them.
#pragma once

namespace fanbeam::core {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kSpeedOfLight_mps = 299792458.0;
inline constexpr double kMeanEarthRadius_m = 6371008.8;  // IUGG, of WGS 84
inline constexpr double kBoltzmann_J_per_K = 1.380649e-23;
// Reference temperature of noise figures (IEEE Std 686).
inline constexpr double kNoiseReferenceTemperature_K = 290.0;

}  // namespace fanbeam::core
