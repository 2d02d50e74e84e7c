#include "tracking/simulation/directions.h"

#include <cmath>

#include "signal/angle/angle_peak.h"
#include "signal/angle/plane_wave.h"

namespace fanbeam::tracking {
namespace {

using signal::Snapshot;

constexpr int kTurns = 10;
constexpr double kLeastShare = 0.1;

}  // namespace

std::vector<double> directions_rad(const Snapshot& snapshot,
                                   const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                                   double beam_sine) {
  signal::AnglePeak first = signal::azimuth_peak(snapshot, elements_m, wavelength_m);
  const double alone_rad = first.azimuth_rad;
  signal::AnglePeak second;
  Snapshot other(snapshot.size());  // the second wave
  for (int turn = 0; turn < kTurns; ++turn) {
    const Snapshot wave = signal::wave_from(signal::without(snapshot, other), elements_m,
                                            wavelength_m, first.azimuth_rad)
                              .values;
    const Snapshot rest = signal::without(snapshot, wave);
    second = signal::azimuth_peak(rest, elements_m, wavelength_m);
    if (second.power < kLeastShare * first.power) return {alone_rad};
    other = signal::wave_from(rest, elements_m, wavelength_m, second.azimuth_rad).values;
    first = signal::azimuth_peak(signal::without(snapshot, other), elements_m, wavelength_m);
  }
  if (std::abs(std::sin(first.azimuth_rad) - std::sin(second.azimuth_rad)) < 0.5 * beam_sine)
    return {alone_rad};
  return {first.azimuth_rad, second.azimuth_rad};
}

}  // namespace fanbeam::tracking
