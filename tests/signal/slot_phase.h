// What motion does to the phase between the slots of a time-division array.
#pragma once

#include "core/constants.h"

namespace fanbeam::tests {

// Phase by which a scatterer's motion turns the beat from one transmitter's slot to the next.
inline double slot_phase_rad(double radial_speed_mps, double slot_period_s, double wavelength_m) {
  return 4.0 * core::kPi * radial_speed_mps * slot_period_s / wavelength_m;
}

}  // namespace fanbeam::tests
