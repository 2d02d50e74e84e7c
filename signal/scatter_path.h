// One way from the antenna to a scatterer and back, as the signal sees it.
#pragma once

#include <complex>

namespace fanbeam::signal {

struct ScatterPath {
  double range_m = 0.0;           // one way, at time 0 of the waveform, to the array's origin
  double radial_speed_mps = 0.0;  // positive receding
  double azimuth_rad = 0.0;       // positive right, in the array's frame
  double elevation_rad = 0.0;     // positive up
  // |amplitude|^2 is the power in watts at one receiver's port. The phase is the scatterer's own:
  // that of the path's length comes on top.
  std::complex<double> amplitude_sqrtW;
};

}  // namespace fanbeam::signal
