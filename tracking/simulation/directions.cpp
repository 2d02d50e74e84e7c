#include "tracking/simulation/directions.h"

#include <cmath>

#include "signal/angle/angle_peak.h"
#include "signal/angle/steering.h"

namespace fanbeam::tracking {
namespace {

using Snapshot = std::vector<std::complex<double>>;

constexpr int kTurns = 10;
constexpr double kLeastShare = 0.1;

Snapshot without(Snapshot snapshot, const Snapshot& wave) {
  for (std::size_t i = 0; i < snapshot.size(); ++i) snapshot[i] -= wave[i];
  return snapshot;
}

// The wave from that direction that fits best.
Snapshot wave_in(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                 double wavelength_m, double azimuth_rad) {
  const auto steering =
      signal::steering_vectors(elements_m, wavelength_m, signal::BeamGrid{{azimuth_rad}});
  std::complex<double> amplitude = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i)
    amplitude += snapshot[i] * std::conj(steering.values[i]) / std::norm(steering.values[i]);
  amplitude /= static_cast<double>(snapshot.size());
  Snapshot wave;
  for (std::size_t i = 0; i < snapshot.size(); ++i) wave.push_back(amplitude * steering.values[i]);
  return wave;
}

}  // namespace

std::vector<double> directions_rad(const Snapshot& snapshot,
                                   const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                                   double beam_sine) {
  signal::AnglePeak first = signal::azimuth_peak(snapshot, elements_m, wavelength_m);
  const double alone_rad = first.azimuth_rad;
  signal::AnglePeak second;
  Snapshot other(snapshot.size());  // the second wave
  for (int turn = 0; turn < kTurns; ++turn) {
    const Snapshot wave =
        wave_in(without(snapshot, other), elements_m, wavelength_m, first.azimuth_rad);
    const Snapshot rest = without(snapshot, wave);
    second = signal::azimuth_peak(rest, elements_m, wavelength_m);
    if (second.power < kLeastShare * first.power) return {alone_rad};
    other = wave_in(rest, elements_m, wavelength_m, second.azimuth_rad);
    first = signal::azimuth_peak(without(snapshot, other), elements_m, wavelength_m);
  }
  if (std::abs(std::sin(first.azimuth_rad) - std::sin(second.azimuth_rad)) < 0.5 * beam_sine)
    return {alone_rad};
  return {first.azimuth_rad, second.azimuth_rad};
}

}  // namespace fanbeam::tracking
