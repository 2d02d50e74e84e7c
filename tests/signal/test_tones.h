// Tones and noise for tests: fixed draws, so that every run sees the same numbers.
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "signal/cube.h"

namespace fanbeam::tests {

// Complex Gaussian, E|n|^2 = power; draw (cell, draw) of a key of the tests' own.
inline std::complex<double> noise(double power, std::uint64_t cell, std::uint32_t trial) {
  const auto pair = core::normal_pair({.seed = 20231, .stream = 1000, .frame = trial}, cell, 0);
  return std::sqrt(0.5 * power) * std::complex<double>(pair[0], pair[1]);
}

// exp(j 2 pi bin n / count), noise of `noise_power` per sample on top.
inline std::vector<std::complex<double>> tone(int count, double bin, double amplitude,
                                              double noise_power = 0.0, std::uint32_t trial = 0) {
  std::vector<std::complex<double>> samples(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    auto& sample = samples[static_cast<std::size_t>(n)];
    sample = std::polar(amplitude, 2.0 * core::kPi * bin * n / count + 0.3);
    if (noise_power > 0.0) sample += noise(noise_power, static_cast<std::uint64_t>(n), trial);
  }
  return samples;
}

// Adds a tone at (range bin, Doppler bin) with the given phase step between channels.
template <typename Real>
void add_tone(signal::Cube<Real>& cube, double range_bin, double doppler_bin, double amplitude,
              double channel_phase_rad = 0.0) {
  for (int c = 0; c < cube.shape.channels; ++c)
    for (int m = 0; m < cube.shape.chirps; ++m)
      for (int n = 0; n < cube.shape.samples; ++n) {
        const double phase =
            2.0 * core::kPi *
                (range_bin * n / cube.shape.samples + doppler_bin * m / cube.shape.chirps) +
            channel_phase_rad * c;
        cube.at(c, m, n) += static_cast<std::complex<Real>>(std::polar(amplitude, phase));
      }
}

template <typename Real>
void add_noise(signal::Cube<Real>& cube, double power, std::uint32_t trial) {
  for (std::size_t i = 0; i < cube.values.size(); ++i)
    cube.values[i] += static_cast<std::complex<Real>>(noise(power, i, trial));
}

}  // namespace fanbeam::tests
