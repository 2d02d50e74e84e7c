// Radar cross-section of a vehicle-like object by its measured lobes over aspect.
//
//   sigma = max(floor, max over lobes of peak 10^(-1.2 ((az - az_i) / w_i)^2
//                                                 -1.2 ((el - el_i) / v_i)^2))
// w and v are 3 dB widths: the lobes of 3GPP TR 38.901 release 19, 7.9.2.1 (RCS model 2, one
// scattering point). There, sectors of 45 deg to each side of a lobe choose it; the lobes are back
// at the floor before a sector ends, so that the strongest is the same.
//
// Azimuth counts from the object's x axis (its front) to the left, elevation up. A lobe without an
// azimuth width is the same all around (roof).
// Neglected: the spread about this mean (object_library.h keeps it), polarisation, frequency.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::materials {

struct AspectLobe {
  double azimuth_rad = 0.0, azimuth_width_rad = 0.0;  // width 0 for all around
  double elevation_rad = 0.0, elevation_width_rad = 1.0;
  double peak_m2 = 0.0;
};

struct LobedRcs {
  double floor_m2 = 0.0;
  std::vector<AspectLobe> lobes;
};

// The direction to the radar in target axes (rcs.h), of unit length.
double lobed_rcs_m2(const LobedRcs& object, const glm::dvec3& direction);

}  // namespace fanbeam::materials
