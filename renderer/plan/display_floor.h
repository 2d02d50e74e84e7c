// The power that a picture shows as black: what additive effects are held against.
#pragma once

#include <cmath>

#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// Received power at `range_m` that the display maps to grey 0: with the stc mapping that of level
// ground with the NRCS of the window's lower end, which falls with R^3; else the lower end itself.
inline double display_floor_W(const sensors::Sensor& sensor, double range_m) {
  const double low = std::pow(10.0, sensor.display.low_dB / 10.0);
  if (sensor.display.mapping != sensors::Display::Mapping::stc) return low;
  return low * sensor.radar_constant_W_m2() * sensors::two_way_width(sensor.antenna.azimuth) *
         sensor.range.cell_m / (range_m * range_m * range_m);
}

// The brightest echo that spreading effects must reckon with, over what is shown as black. Surfaces
// and targets may exceed the window's top: by 27 dB a metal wall facing the radar, by 40 dB 4e5 m^2
// at 200 m.
inline double brightest_over_floor(const sensors::Sensor& sensor) {
  constexpr double kHeadroom_dB = 40.0;
  return std::pow(10.0, (sensor.display.high_dB - sensor.display.low_dB + kHeadroom_dB) / 10.0);
}

}  // namespace fanbeam::renderer
