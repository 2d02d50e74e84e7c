#include "signal/receiver/receiver_noise.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/parallel.h"
#include "core/random_normals.h"
#include "signal/checks_private.h"
#include "signal/receiver/link_budget.h"

namespace fanbeam::signal {
namespace {

core::RandomKey with_stream(core::RandomKey key, std::uint32_t stream) {
  key.stream = stream;
  return key;
}

// Runs body(channel, chirp) for every row.
template <typename Body>
void for_rows(const CubeShape& shape, const Body& body) {
  const auto chirps = static_cast<std::size_t>(shape.chirps);
  core::parallel_for(chirps * static_cast<std::size_t>(shape.channels), [&](std::size_t row) {
    body(static_cast<int>(row / chirps), static_cast<int>(row % chirps));
  });
}

}  // namespace

double noise_sample_W(double noise_figure, double sample_rate_Hz) {
  check_positive("sample_rate_Hz", sample_rate_Hz);
  return noise_density_W_per_Hz(noise_figure) * sample_rate_Hz;
}

template <typename Real>
void add_receiver_noise(const Array& array, const ReceiverNoise& noise, Cube<Real>& cube) {
  check_not_negative("sample_W", noise.sample_W);
  if (cube.shape.channels != array.channels())
    refuse("channels", cube.shape.channels,
           std::to_string(array.channels()) + ", those of the array");
  if (noise.sample_W == 0.0) return;
  const core::RandomKey key = with_stream(noise.key, core::kStreamReceiverNoise);
  const auto part_sqrtW = static_cast<Real>(std::sqrt(0.5 * noise.sample_W));
  // Parts of samples that get noise: real and imaginary ones, which follow each other, or real ones.
  const int parts = noise.complex_baseband ? 2 : 1;
  const int step = 3 - parts;
  for_rows(cube.shape, [&](int channel, int chirp) {
    std::vector<float> normals(static_cast<std::size_t>(parts * cube.shape.samples));
    core::normal_numbers(key, 0, static_cast<std::uint64_t>(parts) * cube.index(channel, chirp, 0),
                         normals.size(), normals.data());
    Real* values = reinterpret_cast<Real*>(cube.values.data() + cube.index(channel, chirp, 0));
    for (std::size_t i = 0; i < normals.size(); ++i)
      values[static_cast<std::size_t>(step) * i] += part_sqrtW * static_cast<Real>(normals[i]);
  });
}

template <typename Real>
std::size_t quantise(const Quantiser& quantiser, Cube<Real>& cube) {
  check_count("bits", quantiser.bits, 1, 24);
  check_positive("full_scale_sqrtW", quantiser.full_scale_sqrtW);
  const double half_steps = std::ldexp(1.0, quantiser.bits - 1);
  const double step = quantiser.full_scale_sqrtW / half_steps;
  std::size_t clipped = 0;
  const auto part = [&](Real value) {
    const double steps = std::nearbyint(static_cast<double>(value) / step);
    const double kept = std::clamp(steps, -half_steps, half_steps - 1.0);
    clipped += kept != steps ? 1 : 0;
    return static_cast<Real>(kept * step);
  };
  for (std::complex<Real>& value : cube.values) value = {part(value.real()), part(value.imag())};
  return clipped;
}

template void add_receiver_noise(const Array&, const ReceiverNoise&, FloatCube&);
template void add_receiver_noise(const Array&, const ReceiverNoise&, DoubleCube&);
template std::size_t quantise(const Quantiser&, FloatCube&);
template std::size_t quantise(const Quantiser&, DoubleCube&);

}  // namespace fanbeam::signal
