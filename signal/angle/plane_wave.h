// One plane wave in a snapshot of an array, and what is left without it.
#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::signal {

using Snapshot = std::vector<std::complex<double>>;

struct PlaneWave {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  std::complex<double> amplitude;
  Snapshot values;  // of every element
};

// The wave from that direction that fits best: its amplitude is the mean of the aligned channels.
PlaneWave wave_from(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                    double wavelength_m, double azimuth_rad, double elevation_rad = 0.0);

Snapshot without(Snapshot snapshot, const Snapshot& wave);

}  // namespace fanbeam::signal
