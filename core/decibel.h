// Decibels at the border between linear power and people.
//
// A power of exactly zero has no decibel value; it is shown as a floor that the caller names.
// Linear results must stay finite: a level is accepted up to +-3000 dB (double ends near 3082 dB).
// Accuracy: round trip within 1e-10 dB over +-350 dB.
#pragma once

namespace fanbeam::core {

inline constexpr double kLargestLevel_dB = 3000.0;
// Of power: 10 / ln 10.
inline constexpr double kDecibelsPerNeper = 4.34294481903251827651;

// 10^(level/10). Throws InputError: E-NONFINITE for NaN or infinity, E-RANGE beyond +-3000 dB.
double power_from_dB(double level_dB);

// 10 log10(power), `floor_dB` for power == 0 and for anything below the floor.
// Throws InputError: E-RANGE for negative power, E-NONFINITE for NaN or infinity.
double dB_from_power(double power, double floor_dB);

}  // namespace fanbeam::core
