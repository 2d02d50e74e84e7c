// Phases of a plane wave at the elements of an array: a_m(u) = exp(-j 2 pi (u . p_m) / wavelength),
// the sign of signal/waveform/array.h. Every |a_m| is 1.
#pragma once

#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "signal/transform/angle_transform.h"

namespace fanbeam::signal {

struct Steering {
  int beams = 0;
  int elements = 0;
  std::vector<std::complex<double>> values;  // beam * elements + element

  const std::complex<double>& at(int beam, int element) const {
    return values[static_cast<std::size_t>(beam) * static_cast<std::size_t>(elements) +
                  static_cast<std::size_t>(element)];
  }
};

// Beams in the order of BeamGrid. Needs an element, a direction and a positive wavelength, and
// finite values throughout; E-RANGE otherwise.
Steering steering_vectors(const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                          const BeamGrid& grid);

}  // namespace fanbeam::signal
