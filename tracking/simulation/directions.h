// Directions of the one or two plane waves that make up a snapshot of an array.
#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::tracking {

// The strongest wave, and a second one where it has at least a tenth of its power and is half a
// beamwidth away. Each is fitted to what the other leaves, ten times in turn (J. Li, P. Stoica,
// "Efficient mixed-spectrum estimation", IEEE Trans. SP-44, 1996). Azimuths in radians, the
// stronger first. Errors as of signal/angle/angle_peak.h.
std::vector<double> directions_rad(const std::vector<std::complex<double>>& snapshot,
                                   const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                                   double beam_sine);

}  // namespace fanbeam::tracking
