#include "signal/angle/steering.h"

#include <glm/geometric.hpp>

#include "signal/checks_private.h"
#include "signal/unit_phasor_private.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {

Steering steering_vectors(const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                          const BeamGrid& grid) {
  const std::size_t beams = grid.azimuths_rad.size() * grid.elevations_rad.size();
  if (elements_m.empty() || beams == 0)
    refuse("steering", 0.0, "at least one element and one direction");
  check_positive("wavelength_m", wavelength_m);
  Steering steering;
  steering.beams = static_cast<int>(beams);
  steering.elements = static_cast<int>(elements_m.size());
  steering.values.reserve(beams * elements_m.size());
  for (const double elevation_rad : grid.elevations_rad)
    for (const double azimuth_rad : grid.azimuths_rad) {
      const glm::dvec3 u = direction(azimuth_rad, elevation_rad);
      for (const glm::dvec3& element_m : elements_m) {
        const double turns = glm::dot(u, element_m) / wavelength_m;
        if (!std::isfinite(turns))
          core::throw_input_error(core::ErrorClass::nonfinite, "steering", turns,
                                  "finite places and directions");
        steering.values.push_back(unit_phasor(-turns));
      }
    }
  return steering;
}

}  // namespace fanbeam::signal
