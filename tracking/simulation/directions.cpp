#include "tracking/simulation/directions.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/angle/angle_peak.h"
#include "signal/angle/plane_wave.h"
#include "signal/detection/tone_bound.h"
#include "signal/detection/two_tones.h"

namespace fanbeam::tracking {
namespace {

using signal::Snapshot;

constexpr int kTurns = 10;
constexpr double kLeastShare = 0.1;
// Beamwidths from which on taking turns gets to the end in ten.
constexpr double kApart = 1.5;

// Waves of one peak: an array of even pitch sees them as two tones. Its y counts to the left, azimuths to the right.
std::vector<double> of_one_peak(const Snapshot& snapshot, double pitch_wavelengths,
                                double alone_rad, double noise_W, double least_apart) {
  const double bins = -static_cast<double>(snapshot.size()) * pitch_wavelengths;
  const auto two =
      signal::two_tones({snapshot}, bins * std::sin(alone_rad), 0.0, noise_W, least_apart);
  if (!two) return {alone_rad};
  const auto& [left, right] = *two;
  const double first = left.bin / bins, second = right.bin / bins;
  const auto [weaker, stronger] = std::minmax(left.power, right.power);
  if (std::abs(first) > 1.0 || std::abs(second) > 1.0 || weaker < kLeastShare * stronger)
    return {alone_rad};
  if (right.power > left.power) return {std::asin(second), std::asin(first)};
  return {std::asin(first), std::asin(second)};
}

}  // namespace

std::vector<double> directions_rad(const Snapshot& snapshot,
                                   const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                                   double beam_sine, double noise_W, double least_apart) {
  signal::AnglePeak first = signal::azimuth_peak(snapshot, elements_m, wavelength_m);
  const double alone_rad = first.azimuth_rad;
  const auto as_one_peak = [&] {
    if (elements_m.size() < 2) return std::vector<double>{alone_rad};
    const double pitch_m = elements_m[1].y - elements_m[0].y;
    return of_one_peak(snapshot, pitch_m / wavelength_m, alone_rad, noise_W, least_apart);
  };
  signal::AnglePeak second;
  Snapshot other(snapshot.size());  // the second wave
  for (int turn = 0; turn < kTurns; ++turn) {
    const Snapshot wave = signal::wave_from(signal::without(snapshot, other), elements_m,
                                            wavelength_m, first.azimuth_rad)
                              .values;
    const Snapshot rest = signal::without(snapshot, wave);
    second = signal::azimuth_peak(rest, elements_m, wavelength_m);
    if (second.power < kLeastShare * first.power) return as_one_peak();
    other = signal::wave_from(rest, elements_m, wavelength_m, second.azimuth_rad).values;
    first = signal::azimuth_peak(signal::without(snapshot, other), elements_m, wavelength_m);
  }
  if (std::abs(std::sin(first.azimuth_rad) - std::sin(second.azimuth_rad)) < kApart * beam_sine)
    return as_one_peak();
  return {first.azimuth_rad, second.azimuth_rad};
}

std::vector<double> direction_sigmas_rad(const Snapshot& snapshot,
                                         const std::vector<double>& directions_rad,
                                         double pitch_wavelengths, double noise_W) {
  // Even over all of them, as measurement_bound.h has it.
  if (snapshot.size() < 2)
    return std::vector<double>(directions_rad.size(), core::kPi / std::sqrt(3.0));
  const double aperture = static_cast<double>(snapshot.size()) * pitch_wavelengths;
  std::vector<double> bins;
  for (const double direction : directions_rad) bins.push_back(-aperture * std::sin(direction));
  const auto bounds =
      signal::tone_bounds(signal::tones_at({snapshot}, bins), snapshot.size(), noise_W);
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < bins.size(); ++i)
    sigmas.push_back(std::min(0.5 / aperture, std::sqrt(bounds[i].variance_bins2) /
                                                  (aperture * std::cos(directions_rad[i]))));
  return sigmas;
}

bool is_lone_wave(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                  double wavelength_m, double azimuth_rad, double share, double noise_W) {
  const signal::PlaneWave wave = signal::wave_from(snapshot, elements_m, wavelength_m, azimuth_rad);
  double all = 0.0, rest = 0.0;
  for (const auto& value : snapshot) all += std::norm(value);
  for (const auto& value : signal::without(snapshot, wave.values)) rest += std::norm(value);
  return rest < share * all + 4.0 * noise_W;
}

}  // namespace fanbeam::tracking
