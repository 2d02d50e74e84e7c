#include "signal/transform/angle_transform.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>

#include "core/parallel.h"
#include "signal/angle/steering.h"
#include "signal/checks_private.h"
#include "signal/transform/tiles_private.h"

namespace fanbeam::signal {
namespace {

template <typename Real>
void check_input(const Cube<Real>& cube) {
  if (cube.shape.count() == 0 || cube.values.size() != cube.shape.count())
    refuse("cube.values", static_cast<double>(cube.values.size()),
           "at least one, and as many as the shape says");
}

}  // namespace

template <typename Real>
void angle_transform(const Cube<Real>& range_doppler, const Window& window, int angle_cells,
                     Cube<Real>& result) {
  check_input(range_doppler);
  const CubeShape& shape = range_doppler.shape;
  const int cells = angle_cells == 0 ? shape.channels : angle_cells;
  if (cells < shape.channels) refuse("angle_cells", cells, "0 or at least the channels");
  std::vector<double> weights = window_weights(window, shape.channels);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  const ColumnTransform<Real> columns(weights, cells, cells / 2, FftDirection::inverse);

  result.shape = {shape.samples, shape.chirps, cells};
  result.values.resize(result.shape.count());
  const auto width = static_cast<std::size_t>(shape.samples);
  const auto chirps = static_cast<std::size_t>(shape.chirps);
  core::parallel_for(chirps, [&](std::size_t chirp) {
    columns.run(range_doppler.values.data(), result.values.data(), width * chirps, chirp * width,
                (chirp + 1) * width);
  });
}

template void angle_transform(const FloatCube&, const Window&, int, FloatCube&);
template void angle_transform(const DoubleCube&, const Window&, int, DoubleCube&);

std::vector<double> angle_cell_azimuths_rad(int angle_cells, double pitch_m, double wavelength_m) {
  if (angle_cells < 1) refuse("angle_cells", angle_cells, "1 or more");
  check_positive("pitch_m", pitch_m);
  check_positive("wavelength_m", wavelength_m);
  std::vector<double> azimuths_rad(static_cast<std::size_t>(angle_cells));
  for (int a = 0; a < angle_cells; ++a) {
    const double turns = static_cast<double>(a - angle_cells / 2) / angle_cells;
    azimuths_rad[static_cast<std::size_t>(a)] =
        std::asin(std::clamp(turns * wavelength_m / pitch_m, -1.0, 1.0));
  }
  return azimuths_rad;
}

template <typename Real>
void beam_transform(const Cube<Real>& range_doppler, const std::vector<glm::dvec3>& elements_m,
                    double wavelength_m, const BeamGrid& grid, const std::vector<double>& weights,
                    Cube<Real>& result) {
  check_input(range_doppler);
  const auto channels = static_cast<std::size_t>(range_doppler.shape.channels);
  if (elements_m.size() != channels)
    refuse("elements_m", static_cast<double>(elements_m.size()), "one per channel");
  if (!weights.empty() && weights.size() != channels)
    refuse("weights", static_cast<double>(weights.size()), "none or one per channel");
  const double sum = weights.empty() ? static_cast<double>(channels)
                                     : std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0.0)) refuse("weights", sum, "a positive sum");
  const Steering steering = steering_vectors(elements_m, wavelength_m, grid);
  const auto beams = static_cast<std::size_t>(steering.beams);

  const CubeShape& shape = range_doppler.shape;
  result.shape = {shape.samples, shape.chirps, steering.beams};
  result.values.assign(result.shape.count(), std::complex<Real>());
  const auto width = static_cast<std::size_t>(shape.samples);
  const auto chirps = static_cast<std::size_t>(shape.chirps);
  core::parallel_for(chirps, [&](std::size_t chirp) {
    for (std::size_t beam = 0; beam < beams; ++beam) {
      std::complex<Real>* const out = result.values.data() + (beam * chirps + chirp) * width;
      for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::complex<Real>* in =
            range_doppler.values.data() + (channel * chirps + chirp) * width;
        const std::complex<double> exact =
            std::conj(steering.at(static_cast<int>(beam), static_cast<int>(channel))) *
            (weights.empty() ? 1.0 : weights[channel]) / sum;
        const auto re = static_cast<Real>(exact.real());
        const auto im = static_cast<Real>(exact.imag());
        // Spelled out: the complex product checks for infinities.
        for (std::size_t i = 0; i < width; ++i)
          out[i] += std::complex<Real>(re * in[i].real() - im * in[i].imag(),
                                       re * in[i].imag() + im * in[i].real());
      }
    }
  });
}

template void beam_transform(const FloatCube&, const std::vector<glm::dvec3>&, double,
                             const BeamGrid&, const std::vector<double>&, FloatCube&);
template void beam_transform(const DoubleCube&, const std::vector<glm::dvec3>&, double,
                             const BeamGrid&, const std::vector<double>&, DoubleCube&);

}  // namespace fanbeam::signal
