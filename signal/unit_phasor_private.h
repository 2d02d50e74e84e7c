// exp(j 2 pi turns), with whole turns taken off first: exact for any number of them.
#pragma once

#include <cmath>
#include <complex>

#include "core/constants.h"

namespace fanbeam::signal {

inline std::complex<double> unit_phasor(double turns) {
  const double phase_rad = 2.0 * core::kPi * (turns - std::nearbyint(turns));
  return {std::cos(phase_rad), std::sin(phase_rad)};
}

}  // namespace fanbeam::signal
