#include "signal/transform/cube_maps.h"

#include <algorithm>
#include <complex>

#include "core/parallel.h"

namespace fanbeam::signal {
namespace {

// Adds `row` of the cube to a row of the map.
template <typename Real>
void gather(const std::complex<Real>* row, int count, Projection projection, double* power_W) {
  for (int i = 0; i < count; ++i) {
    const std::complex<double> value(row[i]);
    const double cell_W = std::norm(value);
    power_W[i] = projection == Projection::max ? std::max(power_W[i], cell_W) : power_W[i] + cell_W;
  }
}

}  // namespace

template <typename Real>
PowerMap range_doppler_map(const Cube<Real>& cube, Projection projection) {
  PowerMap map(cube.shape.chirps, cube.shape.samples);
  core::parallel_for(static_cast<std::size_t>(map.rows), [&](std::size_t row) {
    const int chirp = static_cast<int>(row);
    for (int channel = 0; channel < cube.shape.channels; ++channel)
      gather(&cube.at(channel, chirp, 0), map.columns, projection, &map.at(chirp, 0));
  });
  return map;
}

template <typename Real>
PowerMap range_azimuth_map(const Cube<Real>& cube, Projection projection) {
  PowerMap map(cube.shape.channels, cube.shape.samples);
  core::parallel_for(static_cast<std::size_t>(map.rows), [&](std::size_t row) {
    const int channel = static_cast<int>(row);
    for (int chirp = 0; chirp < cube.shape.chirps; ++chirp)
      gather(&cube.at(channel, chirp, 0), map.columns, projection, &map.at(channel, 0));
  });
  return map;
}

template PowerMap range_doppler_map(const FloatCube&, Projection);
template PowerMap range_doppler_map(const DoubleCube&, Projection);
template PowerMap range_azimuth_map(const FloatCube&, Projection);
template PowerMap range_azimuth_map(const DoubleCube&, Projection);

}  // namespace fanbeam::signal
