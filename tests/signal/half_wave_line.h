// Receivers half a wavelength apart; what they resolve is the same at any wavelength.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "signal/angle/steering.h"
#include "signal/waveform/array.h"

namespace fanbeam::tests {

inline constexpr double kLineWavelength_m = 4e-3;

inline std::vector<glm::dvec3> line_of(int elements) {
  return signal::virtual_elements_m(signal::line_array(1, elements, 0.5 * kLineWavelength_m));
}

}  // namespace fanbeam::tests
