// What comes back from one scatterer: the currency between renderer and signal processing.
#pragma once

#include <cstdint>

namespace fanbeam::core {

// Angles in the antenna frame: azimuth positive right, elevation positive up.
struct Echo {
  double range_m = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double radial_speed_mps = 0.0;  // positive receding
  double power_W = 0.0;           // received at azimuth gain 1
  std::uint16_t material_id = 0;
  std::uint32_t object_id = 0;
};

}  // namespace fanbeam::core
