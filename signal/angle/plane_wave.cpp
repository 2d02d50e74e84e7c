#include "signal/angle/plane_wave.h"

#include "signal/angle/steering.h"

namespace fanbeam::signal {

PlaneWave wave_from(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                    double wavelength_m, double azimuth_rad, double elevation_rad) {
  const Steering steering =
      steering_vectors(elements_m, wavelength_m, BeamGrid{{azimuth_rad}, {elevation_rad}});
  PlaneWave wave{azimuth_rad, elevation_rad, 0.0, {}};
  for (std::size_t i = 0; i < snapshot.size(); ++i)
    wave.amplitude += snapshot[i] * std::conj(steering.values[i]);
  wave.amplitude /= static_cast<double>(snapshot.size());
  for (std::size_t i = 0; i < snapshot.size(); ++i)
    wave.values.push_back(wave.amplitude * steering.values[i]);
  return wave;
}

Snapshot without(Snapshot snapshot, const Snapshot& wave) {
  for (std::size_t i = 0; i < snapshot.size(); ++i) snapshot[i] -= wave[i];
  return snapshot;
}

}  // namespace fanbeam::signal
