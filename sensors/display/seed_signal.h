// Strongest and weakest signal of the published table of the HiVision radar, and its formulas.
//
//   constant power = Pt G^2 lambda^2 c tau phi / ((4 pi)^3 2 cos(elevation minimum) L)
//   minimum signal = constant power / (maximum range)^3
//   maximum signal = constant power / (minimum range)^3
// Source: Devendran B., S. K. Kashyap, T. V. Rama Murthy, "Modeling specifications for HiVision
// Millimeter Wave Radar for multisensory Enhanced Vision Systems", Table 2 (with c = 3e8 m/s, no
// loss L).
//
// The signals assume sigma0 = 1. A sensor with the seed's convention uses the table's c, tau, phi
// (the beam width) and elevation minimum; any other sensor its own range cell, the integral of its
// two-way azimuth pattern, cosine 1 and the end of its last range cell.
// Needs a minimum range above 0. Accuracy: the table's figures within 1e-6.
#pragma once

#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct SignalLimits {
  double constant_power_W_m3 = 0.0;
  double minimum_W = 0.0;
  double maximum_W = 0.0;
};

// Throws InputError E-RANGE when the sensor's minimum range is not above 0.
SignalLimits seed_signal_limits(const Sensor& sensor);

}  // namespace fanbeam::sensors
