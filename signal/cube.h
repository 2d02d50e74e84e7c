// Complex samples over fast time, slow time and channel, and their transforms over range, Doppler
// and angle: one layout for all of them.
#pragma once

#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace fanbeam::signal {

struct CubeShape {
  int samples = 0;   // fast time, or range cells
  int chirps = 0;    // slow time, or Doppler cells
  int channels = 0;  // virtual elements, or angle cells

  std::size_t count() const {
    return static_cast<std::size_t>(samples) * static_cast<std::size_t>(chirps) *
           static_cast<std::size_t>(channels);
  }
  bool operator==(const CubeShape&) const = default;
};

// Index (channel * chirps + chirp) * samples + sample: samples are neighbours.
// A value's square is a power in watts at the receiver's port; transforms are calibrated so that a
// lone tone's peak keeps its power.
template <typename Real>
struct Cube {
  CubeShape shape;
  std::vector<std::complex<Real>> values;

  Cube() = default;
  explicit Cube(const CubeShape& its_shape) : shape(its_shape), values(its_shape.count()) {}

  std::size_t index(int channel, int chirp, int sample) const {
    return (static_cast<std::size_t>(channel) * static_cast<std::size_t>(shape.chirps) +
            static_cast<std::size_t>(chirp)) *
               static_cast<std::size_t>(shape.samples) +
           static_cast<std::size_t>(sample);
  }
  std::complex<Real>& at(int channel, int chirp, int sample) {
    return values[index(channel, chirp, sample)];
  }
  const std::complex<Real>& at(int channel, int chirp, int sample) const {
    return values[index(channel, chirp, sample)];
  }
};

// What a receiver without quadrature keeps: sqrt(2) times the real part, so that the mean square
// keeps the power.
template <typename Real>
void keep_real(Cube<Real>& cube) {
  for (std::complex<Real>& value : cube.values)
    value = static_cast<Real>(std::numbers::sqrt2) * value.real();
}

using FloatCube = Cube<float>;
using DoubleCube = Cube<double>;

}  // namespace fanbeam::signal
