#include "signal/waveform/array.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>

#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

constexpr int kMostOnOneSide = 256;
constexpr int kMostChannels = 4096;

void check_positions(const char* field, const std::vector<glm::dvec3>& positions_m) {
  check_count(field, static_cast<double>(positions_m.size()), 1, kMostOnOneSide);
  for (const glm::dvec3& position_m : positions_m)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(position_m[axis]))
        core::throw_input_error(core::ErrorClass::nonfinite, field, position_m[axis],
                                "finite positions in metres");
}

}  // namespace

Array line_array(int transmitters, int receivers, double pitch_m) {
  check_count("transmitters", transmitters, 1, kMostOnOneSide);
  check_count("receivers", receivers, 1, kMostOnOneSide);
  check_positive("pitch_m", pitch_m);
  Array array;
  array.transmitters_m.clear();
  array.receivers_m.clear();
  for (int i = 0; i < transmitters; ++i)
    array.transmitters_m.emplace_back(0.0, (i - 0.5 * (transmitters - 1)) * receivers * pitch_m,
                                      0.0);
  for (int i = 0; i < receivers; ++i)
    array.receivers_m.emplace_back(0.0, (i - 0.5 * (receivers - 1)) * pitch_m, 0.0);
  check(array);
  return array;
}

std::vector<glm::dvec3> virtual_elements_m(const Array& array) {
  std::vector<glm::dvec3> elements_m;
  for (const glm::dvec3& transmitter_m : array.transmitters_m)
    for (const glm::dvec3& receiver_m : array.receivers_m)
      elements_m.push_back(transmitter_m + receiver_m);
  return elements_m;
}

bool is_uniform_line(const std::vector<glm::dvec3>& elements_m) {
  if (elements_m.size() < 2) return true;
  const glm::dvec3 pitch_m = elements_m[1] - elements_m[0];
  const double length_m = glm::length(pitch_m);
  if (!(length_m > 0.0)) return false;
  for (std::size_t i = 2; i < elements_m.size(); ++i)
    if (glm::length(elements_m[i] - elements_m[i - 1] - pitch_m) > 1e-6 * length_m) return false;
  return true;
}

double unambiguous_sine(const std::vector<glm::dvec3>& elements_m, double wavelength_m) {
  if (elements_m.size() < 2 || !is_uniform_line(elements_m)) return 1.0;
  const glm::dvec3 pitch_m = elements_m[1] - elements_m[0];
  const double across_m = std::abs(pitch_m.y);
  if (std::hypot(pitch_m.x, pitch_m.z) > 1e-6 * across_m) return 1.0;
  const double sine = 0.5 * wavelength_m / across_m;
  return sine < 1.0 - 1e-9 ? sine : 1.0;  // half a wavelength, rounded
}

void check(const Array& array) {
  check_positions("transmitters_m", array.transmitters_m);
  check_positions("receivers_m", array.receivers_m);
  if (array.channels() > kMostChannels)
    core::throw_input_error(core::ErrorClass::limit, "channels", array.channels(),
                            "at most " + std::to_string(kMostChannels));
}

glm::dvec3 direction(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace fanbeam::signal
