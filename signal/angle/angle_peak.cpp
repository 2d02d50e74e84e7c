#include "signal/angle/angle_peak.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {
namespace {

using Snapshot = std::vector<std::complex<double>>;

struct Beamformer {
  const Snapshot& snapshot;
  const std::vector<glm::dvec3>& elements_m;
  double wavelength_m;

  double power(double azimuth_rad, double elevation_rad) const {
    const glm::dvec3 u = direction(azimuth_rad, elevation_rad);
    std::complex<double> sum = 0.0;
    for (std::size_t m = 0; m < snapshot.size(); ++m)
      sum += snapshot[m] *
             std::polar(1.0, 2.0 * core::kPi * glm::dot(u, elements_m[m]) / wavelength_m);
    return std::norm(sum) / static_cast<double>(snapshot.size() * snapshot.size());
  }

  double aperture_m() const {
    double most_m = 0.0;
    for (const glm::dvec3& a : elements_m)
      most_m = std::max(most_m, glm::length(a - elements_m[0]));
    return most_m;
  }
  // Steps over a half-turn of sines, at most a quarter of the beamwidth each.
  int scan_steps() const { return steps_for(aperture_m()); }
  int vertical_steps() const {
    double aperture_m = 0.0;
    for (const glm::dvec3& a : elements_m)
      aperture_m = std::max(aperture_m, std::abs(a.z - elements_m[0].z));
    return aperture_m > 0.0 ? steps_for(aperture_m) : 0;
  }
  // Of elements above each other all azimuths are one.
  bool is_vertical() const {
    return std::all_of(elements_m.begin(), elements_m.end(), [&](const glm::dvec3& a) {
      return a.x == elements_m[0].x && a.y == elements_m[0].y;
    });
  }
  int steps_for(double aperture_m) const {
    // The farthest element from the first is at least half the aperture away.
    const double steps = std::ceil(16.0 * aperture_m / wavelength_m);
    return static_cast<int>(std::clamp(steps, 8.0, 20000.0));
  }
};

void check_input(const Beamformer& beam) {
  if (beam.snapshot.empty() || beam.snapshot.size() != beam.elements_m.size())
    refuse("snapshot", static_cast<double>(beam.snapshot.size()), "one value per element");
  check_finite("snapshot", beam.snapshot);
  check_positive("wavelength_m", beam.wavelength_m);
}

// Place of the maximum of `f` between two places either side of it.
template <typename Function>
double climbed(const Function& f, double low, double high) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double f_left = f(left);
  double f_right = f(right);
  while (high - low > 1e-10) {
    if (f_left < f_right) {
      low = left;
      left = right;
      f_left = f_right;
      right = low + golden * (high - low);
      f_right = f(right);
    } else {
      high = right;
      right = left;
      f_right = f_left;
      left = high - golden * (high - low);
      f_left = f(left);
    }
  }
  return 0.5 * (low + high);
}

double angle_of_step(int step, int steps, double widest = 1.0) {
  if (steps == 0) return 0.0;
  return std::asin(std::clamp(widest * (2.0 * step / steps - 1.0), -1.0, 1.0));
}

// From a step of the scan: `reach_rad` to either side and `rise_rad` up and down hold its maximum.
AnglePeak climbed_direction(const Beamformer& beam, AnglePeak peak, double reach_rad,
                            double rise_rad) {
  const auto near = [](double centre, double reach) {
    return std::pair(std::max(-0.5 * core::kPi, centre - reach),
                     std::min(0.5 * core::kPi, centre + reach));
  };
  constexpr int kMostRounds = 60;
  for (int round = 0; round < kMostRounds; ++round) {
    const AnglePeak before = peak;
    const auto [left, right] = near(peak.azimuth_rad, reach_rad);
    peak.azimuth_rad =
        climbed([&](double azimuth_rad) { return beam.power(azimuth_rad, peak.elevation_rad); },
                left, right);
    const auto [low, high] = near(peak.elevation_rad, rise_rad);
    peak.elevation_rad =
        climbed([&](double elevation_rad) { return beam.power(peak.azimuth_rad, elevation_rad); },
                low, high);
    if (std::abs(peak.azimuth_rad - before.azimuth_rad) +
            std::abs(peak.elevation_rad - before.elevation_rad) <
        1e-9)
      break;
  }
  peak.power = beam.power(peak.azimuth_rad, peak.elevation_rad);
  return peak;
}

// Half a wavelength apart, elements see both ends of a scan alike: a maximum beside one of them may be
// found at the other, from which nothing climbs to it. Of equal maxima the first stays.
void take_if_stronger(AnglePeak& peak, const AnglePeak& from_other_end) {
  constexpr double kRounding = 1e-9;
  if (from_other_end.power > (1.0 + kRounding) * peak.power) peak = from_other_end;
}

}  // namespace

AnglePeak direction_peak(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                         double wavelength_m) {
  const Beamformer beam{snapshot, elements_m, wavelength_m};
  check_input(beam);
  const int rows = beam.vertical_steps();
  if (rows == 0) return azimuth_peak(snapshot, elements_m, wavelength_m);
  const int steps = beam.is_vertical() ? 0 : beam.scan_steps();
  AnglePeak peak;
  peak.power = -1.0;
  for (int row = 0; row <= rows; ++row)
    for (int step = 0; step <= steps; ++step) {
      const double azimuth_rad = angle_of_step(step, steps);
      const double elevation_rad = angle_of_step(row, rows);
      // Straight up and down all azimuths are one.
      if ((row == 0 || row == rows) && step > 0) continue;
      const double power = beam.power(azimuth_rad, elevation_rad);
      if (power > peak.power) peak = {azimuth_rad, elevation_rad, power};
    }
  const double reach_rad = steps == 0 ? 0.0 : 2.0 * core::kPi / steps;
  const double rise_rad = 2.0 * core::kPi / rows;
  const auto climb = [&](double azimuth_rad, double elevation_rad) {
    return climbed_direction(beam, {azimuth_rad, elevation_rad}, reach_rad, rise_rad);
  };
  const AnglePeak found = peak;
  const bool at_side = steps > 0 && std::abs(found.azimuth_rad) == angle_of_step(steps, steps);
  const bool at_height = std::abs(found.elevation_rad) == angle_of_step(rows, rows);
  peak = climb(found.azimuth_rad, found.elevation_rad);
  if (at_side) take_if_stronger(peak, climb(-found.azimuth_rad, found.elevation_rad));
  if (at_height) take_if_stronger(peak, climb(found.azimuth_rad, -found.elevation_rad));
  return peak;
}

AnglePeak azimuth_peak(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                       double wavelength_m, double elevation_rad) {
  const Beamformer beam{snapshot, elements_m, wavelength_m};
  check_input(beam);
  if (!(beam.aperture_m() > 0.0)) return {0.0, elevation_rad, beam.power(0.0, elevation_rad)};
  const int steps = beam.scan_steps();
  const double widest =
      std::min(1.0, unambiguous_sine(elements_m, wavelength_m) / std::cos(elevation_rad));
  const auto angle_rad = [&](int step) { return angle_of_step(step, steps, widest); };
  int best = 0;
  double best_power = -1.0;
  for (int step = 0; step <= steps; ++step) {
    const double power = beam.power(angle_rad(step), elevation_rad);
    if (power > best_power) {
      best_power = power;
      best = step;
    }
  }
  const auto climb = [&](int step) {
    AnglePeak peak;
    peak.elevation_rad = elevation_rad;
    peak.azimuth_rad =
        climbed([&](double azimuth_rad) { return beam.power(azimuth_rad, elevation_rad); },
                angle_rad(step - 1), angle_rad(step + 1));
    // A peak beside one end is climbed from the other, which looks the same.
    const double sine = std::sin(peak.azimuth_rad);
    if (std::abs(sine) > widest)
      peak.azimuth_rad = std::asin(sine - std::copysign(2.0 * widest, sine));
    peak.power = beam.power(peak.azimuth_rad, elevation_rad);
    return peak;
  };
  AnglePeak peak = climb(best);
  if (best == 0 || best == steps) take_if_stronger(peak, climb(steps - best));
  return peak;
}

}  // namespace fanbeam::signal
