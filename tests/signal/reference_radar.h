// The reference radar: 76 GHz, chirps of 20 us, 400 samples each.
#pragma once

#include "core/constants.h"

namespace fanbeam::tests {

inline constexpr double kWavelength_m = core::kSpeedOfLight_mps / 76e9;
inline constexpr double kSlot_s = 20e-6;
inline constexpr double kRate_Hz = 20e6;

}  // namespace fanbeam::tests
