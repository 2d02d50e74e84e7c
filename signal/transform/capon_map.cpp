#include "signal/transform/capon_map.h"

#include "core/parallel.h"
#include "signal/angle/spatial_spectrum.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kLoading = 1e-3;

Covariance covariance_at(const FloatCube& cube, int range_cell, double scale) {
  const int channels = cube.shape.channels;
  Covariance covariance;
  covariance.elements = channels;
  covariance.values.resize(static_cast<std::size_t>(channels) * static_cast<std::size_t>(channels));
  for (int doppler = 0; doppler < cube.shape.chirps; ++doppler)
    for (int row = 0; row < channels; ++row) {
      const std::complex<double> value = cube.at(row, doppler, range_cell);
      for (int column = 0; column <= row; ++column)
        covariance.at(row, column) +=
            value * std::conj(std::complex<double>(cube.at(column, doppler, range_cell)));
    }
  for (int row = 0; row < channels; ++row)
    for (int column = 0; column <= row; ++column) {
      covariance.at(row, column) *= scale;
      covariance.at(column, row) = std::conj(covariance.at(row, column));
    }
  return covariance;
}

}  // namespace

PowerMap capon_range_azimuth(const FloatCube& range_doppler,
                             const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                             const std::vector<double>& azimuths_rad,
                             double noise_bandwidth_cells) {
  if (elements_m.size() != static_cast<std::size_t>(range_doppler.shape.channels))
    refuse("elements_m", static_cast<double>(elements_m.size()), "one per channel");
  check_positive("noise_bandwidth_cells", noise_bandwidth_cells);
  const Steering steering = steering_vectors(elements_m, wavelength_m, {azimuths_rad});
  PowerMap map(static_cast<int>(azimuths_rad.size()), range_doppler.shape.samples);
  core::parallel_for(static_cast<std::size_t>(map.columns), [&](std::size_t column) {
    const int cell = static_cast<int>(column);
    const std::vector<double> powers = capon_spectrum(
        covariance_at(range_doppler, cell, 1.0 / noise_bandwidth_cells), steering, kLoading);
    for (int row = 0; row < map.rows; ++row)
      map.at(row, cell) = powers[static_cast<std::size_t>(row)];
  });
  return map;
}

}  // namespace fanbeam::signal
