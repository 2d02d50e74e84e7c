#include "signal/detection/cube_tone.h"

#include <cstddef>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/detection/tone.h"
#include "signal/detection/tone_phasors_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

using Line = std::vector<std::complex<double>>;

// Numbers of a row, real and imaginary parts in turn, times the two parts of a phasor, apart.
template <typename Real>
inline void add_times(const Real* row, std::size_t count, std::complex<double> phasor,
                      double* by_real, double* by_imaginary) {
  const double re = phasor.real(), im = phasor.imag();
  for (std::size_t i = 0; i < count; ++i) {
    by_real[i] += static_cast<double>(row[i]) * re;
    by_imaginary[i] += static_cast<double>(row[i]) * im;
  }
}

// Sums of products with two rows of numbers, in lanes of their own so that they are vector code.
template <typename Real>
inline std::complex<double> dot(const Real* row, const double* to_real, const double* to_imaginary,
                                std::size_t count) {
  constexpr std::size_t kLanes = 8;
  double re[kLanes] = {}, im[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto value = static_cast<double>(row[i + lane]);
      re[lane] += value * to_real[i + lane];
      im[lane] += value * to_imaginary[i + lane];
    }
  for (; i < count; ++i) {
    re[0] += static_cast<double>(row[i]) * to_real[i];
    im[0] += static_cast<double>(row[i]) * to_imaginary[i];
  }
  double sum_re = 0.0, sum_im = 0.0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    sum_re += re[lane];
    sum_im += im[lane];
  }
  return {sum_re, sum_im};
}

FANBEAM_HOT(void, add_row,
            (const float* row, std::size_t count, std::complex<double> phasor, double* by_real,
             double* by_imaginary),
            (row, count, phasor, by_real, by_imaginary)) {
  add_times(row, count, phasor, by_real, by_imaginary);
}
FANBEAM_HOT(void, add_row,
            (const double* row, std::size_t count, std::complex<double> phasor, double* by_real,
             double* by_imaginary),
            (row, count, phasor, by_real, by_imaginary)) {
  add_times(row, count, phasor, by_real, by_imaginary);
}
FANBEAM_HOT(std::complex<double>, sum_row,
            (const float* row, const double* to_real, const double* to_imaginary,
             std::size_t count),
            (row, to_real, to_imaginary, count)) {
  return dot(row, to_real, to_imaginary, count);
}
FANBEAM_HOT(std::complex<double>, sum_row,
            (const double* row, const double* to_real, const double* to_imaginary,
             std::size_t count),
            (row, to_real, to_imaginary, count)) {
  return dot(row, to_real, to_imaginary, count);
}

template <typename Real>
const Real* numbers_of(const Cube<Real>& beat, std::size_t channel, int chirp) {
  return reinterpret_cast<const Real*>(&beat.at(static_cast<int>(channel), chirp, 0));
}

// Per channel, a line over fast time.
template <typename Real>
ToneRecords slow_time_summed(const Cube<Real>& beat, const Line& over_chirps) {
  ToneRecords lines(static_cast<std::size_t>(beat.shape.channels));
  core::parallel_for(lines.size(), [&](std::size_t channel) {
    const auto count = 2 * static_cast<std::size_t>(beat.shape.samples);
    std::vector<double> by_real(count), by_imaginary(count);
    for (int m = 0; m < beat.shape.chirps; ++m)
      add_row(numbers_of(beat, channel, m), count, over_chirps[static_cast<std::size_t>(m)],
              by_real.data(), by_imaginary.data());
    for (std::size_t i = 0; i < count; i += 2)
      lines[channel].emplace_back(by_real[i] - by_imaginary[i + 1],
                                  by_real[i + 1] + by_imaginary[i]);
  });
  return lines;
}

// Per channel, a line over slow time.
template <typename Real>
ToneRecords fast_time_summed(const Cube<Real>& beat, const Line& over_samples) {
  std::vector<double> to_real, to_imaginary;
  for (const std::complex<double>& phasor : over_samples) {
    to_real.insert(to_real.end(), {phasor.real(), -phasor.imag()});
    to_imaginary.insert(to_imaginary.end(), {phasor.imag(), phasor.real()});
  }
  ToneRecords lines(static_cast<std::size_t>(beat.shape.channels));
  core::parallel_for(lines.size(), [&](std::size_t channel) {
    for (int m = 0; m < beat.shape.chirps; ++m)
      lines[channel].push_back(sum_row(numbers_of(beat, channel, m), to_real.data(),
                                       to_imaginary.data(), to_real.size()));
  });
  return lines;
}

}  // namespace

template <typename Real>
CubeTone refined_in_cube(const Cube<Real>& beat, double range_bin, double doppler_bin,
                         const ToneWeights& weights) {
  const CubeShape& shape = beat.shape;
  const auto fits = [](const std::vector<double>& line, int count) {
    return line.empty() || line.size() == static_cast<std::size_t>(count);
  };
  if (shape.samples < 2 || shape.chirps < 2 || shape.channels < 1 ||
      beat.values.size() != shape.count() || !fits(weights.samples, shape.samples) ||
      !fits(weights.chirps, shape.chirps))
    refuse("cube.shape", static_cast<double>(shape.count()),
           "two samples and chirps or more, with weights of their number");
  const auto samples = static_cast<std::size_t>(shape.samples);
  const auto chirps = static_cast<std::size_t>(shape.chirps);
  CubeTone tone{range_bin, doppler_bin, {}};
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    const auto fast =
        slow_time_summed(beat, tone_phasors(chirps, tone.doppler_bin, weights.chirps));
    tone.range_bin = refined_tone(fast, tone.range_bin, weights.samples).bin;
    const auto slow =
        fast_time_summed(beat, tone_phasors(samples, tone.range_bin, weights.samples));
    Tone over_chirps = refined_tone(slow, tone.doppler_bin, weights.chirps);
    tone.doppler_bin = over_chirps.bin;
    tone.snapshot = std::move(over_chirps.amplitudes);
  }
  const std::complex<double> to_middle = unit_phasor(middle_turns(chirps, tone.doppler_bin));
  const double sum = sum_of_weights(samples, weights.samples);
  for (std::complex<double>& value : tone.snapshot) value *= to_middle / sum;
  return tone;
}

template CubeTone refined_in_cube(const FloatCube&, double, double, const ToneWeights&);
template CubeTone refined_in_cube(const DoubleCube&, double, double, const ToneWeights&);

}  // namespace fanbeam::signal
