#include "signal/angle/joint_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/angle/steering.h"

namespace fanbeam::signal {
namespace {

constexpr int kSteps = 12, kHalvings = 5;
constexpr double kThere_rad = 1e-9;

using Elements = std::vector<glm::dvec3>;

PlaneWave wave_at(const Elements& elements_m, double wavelength_m, double azimuth_rad,
                  double elevation_rad, std::complex<double> amplitude) {
  PlaneWave wave{azimuth_rad, elevation_rad, amplitude, {}};
  for (const auto& value :
       steering_vectors(elements_m, wavelength_m, {{azimuth_rad}, {elevation_rad}}).values)
    wave.values.push_back(amplitude * value);
  return wave;
}

double left(const Snapshot& snapshot, const std::vector<PlaneWave>& waves, Snapshot& rest) {
  rest = snapshot;
  for (const PlaneWave& wave : waves) rest = without(rest, wave.values);
  double sum = 0.0;
  for (const auto& value : rest) sum += std::norm(value);
  return sum;
}

// Real parts above imaginary ones; for each wave the derivatives by azimuth and by both parts of the amplitude.
Eigen::MatrixXd derivatives(const Elements& elements_m, double wavelength_m,
                            const std::vector<PlaneWave>& waves) {
  constexpr double kStep_rad = 1e-6;
  const auto elements = static_cast<Eigen::Index>(elements_m.size());
  Eigen::MatrixXd result(2 * elements, 3 * static_cast<Eigen::Index>(waves.size()));
  Eigen::Index column = 0;
  const auto put = [&](const Snapshot& values) {
    for (Eigen::Index m = 0; m < elements; ++m) {
      result(m, column) = values[static_cast<std::size_t>(m)].real();
      result(elements + m, column) = values[static_cast<std::size_t>(m)].imag();
    }
    ++column;
  };
  for (const PlaneWave& wave : waves) {
    const auto at = [&](double turn_rad, std::complex<double> amplitude) {
      return wave_at(elements_m, wavelength_m, wave.azimuth_rad + turn_rad, wave.elevation_rad,
                     amplitude)
          .values;
    };
    Snapshot turned = without(at(kStep_rad, wave.amplitude), at(-kStep_rad, wave.amplitude));
    for (auto& value : turned) value /= 2.0 * kStep_rad;
    put(turned);
    put(at(0.0, 1.0));
    put(at(0.0, {0.0, 1.0}));
  }
  return result;
}

std::vector<PlaneWave> moved(const Elements& elements_m, double wavelength_m,
                             const std::vector<PlaneWave>& waves, const Eigen::VectorXd& step) {
  std::vector<PlaneWave> result;
  Eigen::Index at = 0;
  for (const PlaneWave& wave : waves) {
    const double azimuth_rad =
        std::clamp(wave.azimuth_rad + step(at), -0.5 * core::kPi, 0.5 * core::kPi);
    result.push_back(wave_at(elements_m, wavelength_m, azimuth_rad, wave.elevation_rad,
                             wave.amplitude + std::complex<double>(step(at + 1), step(at + 2))));
    at += 3;
  }
  return result;
}

}  // namespace

Snapshot fit_together(const Snapshot& snapshot, const Elements& elements_m, double wavelength_m,
                      double most_step_rad, std::vector<PlaneWave>& waves) {
  Snapshot rest;
  double left_W = left(snapshot, waves, rest);
  if (waves.empty() || 2 * elements_m.size() <= 3 * waves.size()) return rest;
  const auto elements = static_cast<Eigen::Index>(elements_m.size());
  for (int turn = 0; turn < kSteps; ++turn) {
    Eigen::VectorXd wanted(2 * elements);
    for (Eigen::Index m = 0; m < elements; ++m) {
      wanted(m) = rest[static_cast<std::size_t>(m)].real();
      wanted(elements + m) = rest[static_cast<std::size_t>(m)].imag();
    }
    Eigen::VectorXd step =
        derivatives(elements_m, wavelength_m, waves).colPivHouseholderQr().solve(wanted);
    double furthest_rad = 0.0;
    for (Eigen::Index i = 0; i < step.size(); i += 3)
      furthest_rad = std::max(furthest_rad, std::abs(step(i)));
    if (!std::isfinite(furthest_rad)) return rest;
    if (furthest_rad > most_step_rad) step *= most_step_rad / furthest_rad;
    bool better = false;
    for (int half = 0; half < kHalvings && !better; ++half, step *= 0.5) {
      std::vector<PlaneWave> tried = moved(elements_m, wavelength_m, waves, step);
      Snapshot tried_rest;
      const double tried_W = left(snapshot, tried, tried_rest);
      if (!(tried_W < left_W)) continue;
      better = true;
      waves = std::move(tried);
      rest = std::move(tried_rest);
      left_W = tried_W;
    }
    if (!better || furthest_rad < kThere_rad) break;
  }
  return rest;
}

}  // namespace fanbeam::signal
