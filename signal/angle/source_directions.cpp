#include "signal/angle/source_directions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/errors.h"
#include "signal/angle/angle_peak.h"
#include "signal/angle/joint_fit.h"
#include "signal/angle/plane_wave.h"
#include "signal/angle/spatial_spectrum.h"
#include "signal/checks_private.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {
namespace {

constexpr double kLeastShare = 0.01;
constexpr double kLeastBeams = 0.2;  // between two directions
constexpr double kBeamwidth = 0.8859;
constexpr int kBeamsOfGrid = 16;  // within a beamwidth
constexpr int kTurns = 10;
constexpr double kStill = 1e-6;           // of the sine
constexpr double kLeastRelative = 1e-12;  // of the strongest, where there is no noise

struct Line {
  const std::vector<glm::dvec3>& elements_m;
  double wavelength_m;
};

double energy(const Snapshot& snapshot) {
  double sum = 0.0;
  for (const auto& value : snapshot) sum += std::norm(value);
  return sum;
}

// Even in the sine, over what the line tells apart.
std::vector<double> grid_rad(const Line& line) {
  const double widest = unambiguous_sine(line.elements_m, line.wavelength_m);
  const int steps = kBeamsOfGrid * static_cast<int>(line.elements_m.size());
  std::vector<double> azimuths;
  for (int i = 0; i <= steps; ++i)
    azimuths.push_back(std::asin(widest * std::clamp(2.0 * i / steps - 1.0, -1.0, 1.0)));
  return azimuths;
}

// Of a spectrum over the smoothed covariance, the strongest first.
std::vector<double> candidates_rad(const Snapshot& snapshot, const Line& line, AngleMethod method,
                                   double noise_W) {
  const auto elements = static_cast<int>(snapshot.size());
  const int kept = std::max(3, static_cast<int>(std::lround(2.0 * elements / 3.0)));
  const Covariance covariance = smoothed_covariance({snapshot}, kept);
  const std::vector<double> azimuths = grid_rad(line);
  const Steering steering = steering_vectors(
      {line.elements_m.begin(), line.elements_m.begin() + kept}, line.wavelength_m, {azimuths});
  const std::vector<double> values = eigenvalues(covariance);
  const double least_W = std::max(kLeastOverNoise * noise_W, kLeastRelative * values.back());
  std::size_t most = static_cast<std::size_t>(kept) - 1;
  std::vector<double> powers;
  if (method == AngleMethod::music) {
    const auto above =
        std::count_if(values.begin(), values.end(), [&](double value) { return value > least_W; });
    most = std::clamp<std::size_t>(static_cast<std::size_t>(above), 1, most);
    powers = music_spectrum(covariance, steering, static_cast<int>(most));
  } else {
    constexpr double kLoading = 1e-3;
    powers = capon_spectrum(covariance, steering, kLoading);
  }
  std::vector<double> result;
  for (const SpectrumPeak& peak : spectrum_peaks(powers)) {
    if (result.size() == most) break;
    if (method == AngleMethod::capon && peak.power < least_W) break;
    const auto below = static_cast<std::size_t>(peak.beam);
    const double share = peak.beam - std::floor(peak.beam);
    const std::size_t above = std::min(below + 1, azimuths.size() - 1);
    result.push_back(
        std::asin((1.0 - share) * std::sin(azimuths[below]) + share * std::sin(azimuths[above])));
  }
  return result;
}

struct Fit {
  std::vector<PlaneWave> waves;
  double left_W = 0.0;  // sum over the elements
};

double beam_sine(const Line& line) {
  const double pitch_m = glm::length(line.elements_m[1] - line.elements_m[0]);
  return kBeamwidth * line.wavelength_m / (static_cast<double>(line.elements_m.size()) * pitch_m);
}

// The waves near these directions, each fitted to what the others leave, then all together.
Fit fitted(const Snapshot& snapshot, const Line& line, const std::vector<double>& azimuths_rad) {
  Fit fit;
  Snapshot rest = snapshot;
  for (const double azimuth_rad : azimuths_rad) {
    fit.waves.push_back(wave_from(rest, line.elements_m, line.wavelength_m, azimuth_rad));
    rest = without(rest, fit.waves.back().values);
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    double furthest = 0.0;
    for (PlaneWave& wave : fit.waves) {
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] += wave.values[i];
      const double azimuth_rad = azimuth_peak(rest, line.elements_m, line.wavelength_m).azimuth_rad;
      furthest = std::max(furthest, std::abs(std::sin(azimuth_rad) - std::sin(wave.azimuth_rad)));
      wave = wave_from(rest, line.elements_m, line.wavelength_m, azimuth_rad);
      rest = without(rest, wave.values);
    }
    if (furthest < kStill) break;
  }
  if (fit.waves.size() > 1)
    rest = fit_together(snapshot, line.elements_m, line.wavelength_m, 0.25 * beam_sine(line),
                        fit.waves);
  std::stable_sort(fit.waves.begin(), fit.waves.end(), [](const PlaneWave& a, const PlaneWave& b) {
    return std::norm(a.amplitude) > std::norm(b.amplitude);
  });
  fit.left_W = energy(rest);
  return fit;
}

bool holds(const Fit& fit, double least_sine) {
  for (std::size_t i = 0; i < fit.waves.size(); ++i) {
    if (std::norm(fit.waves[i].amplitude) < kLeastShare * std::norm(fit.waves[0].amplitude))
      return false;
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(std::sin(fit.waves[i].azimuth_rad) - std::sin(fit.waves[j].azimuth_rad)) <
          least_sine)
        return false;
  }
  return true;
}

}  // namespace

std::string_view name(AngleMethod method) {
  switch (method) {
    case AngleMethod::beamforming:
      return "beamforming";
    case AngleMethod::capon:
      return "capon";
    case AngleMethod::music:
      return "music";
  }
  throw core::InternalError("unknown angle method");
}

std::optional<AngleMethod> angle_method(std::string_view text) {
  for (const AngleMethod method :
       {AngleMethod::beamforming, AngleMethod::capon, AngleMethod::music})
    if (name(method) == text) return method;
  return std::nullopt;
}

std::vector<SourceDirection> source_directions(const Snapshot& snapshot,
                                               const std::vector<glm::dvec3>& elements_m,
                                               double wavelength_m, AngleMethod method,
                                               double noise_W) {
  check_not_negative("noise_W", noise_W);
  const AnglePeak alone = direction_peak(snapshot, elements_m, wavelength_m);
  if (method == AngleMethod::beamforming || elements_m.size() < kFewestElements)
    return {{alone.azimuth_rad, alone.elevation_rad, alone.power}};
  if (!is_uniform_line(elements_m))
    core::throw_input_error(core::ErrorClass::unsupported, "angle method",
                            std::string(name(method)),
                            "elements on a line at one pitch, or beamforming");
  const Line line{elements_m, wavelength_m};
  const std::vector<double> candidates = candidates_rad(snapshot, line, method, noise_W);
  Fit best = fitted(snapshot, line, {alone.azimuth_rad});
  for (std::size_t count = 2; count <= candidates.size(); ++count) {
    Fit more =
        fitted(snapshot, line,
               {candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count)});
    if (!(best.left_W - more.left_W > kLeastOverNoise * noise_W) ||
        !holds(more, kLeastBeams * beam_sine(line)))
      break;
    best = std::move(more);
  }
  std::vector<SourceDirection> result;
  for (const PlaneWave& wave : best.waves)
    result.push_back({wave.azimuth_rad, wave.elevation_rad, std::norm(wave.amplitude)});
  return result;
}

}  // namespace fanbeam::signal
