#include "signal/detection/cube_tone.h"

#include <cstddef>

#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/detection/tone.h"
#include "signal/detection/tone_phasors_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

using Line = std::vector<std::complex<double>>;

// a += b c, without the library's check for infinities.
inline void add_product(std::complex<double>& a, std::complex<double> b, std::complex<double> c) {
  a += std::complex<double>(b.real() * c.real() - b.imag() * c.imag(),
                            b.real() * c.imag() + b.imag() * c.real());
}

// Per channel, a line over fast time.
template <typename Real>
ToneRecords slow_time_summed(const Cube<Real>& beat, const Line& over_chirps) {
  ToneRecords lines(static_cast<std::size_t>(beat.shape.channels));
  core::parallel_for(lines.size(), [&](std::size_t channel) {
    Line& line = lines[channel];
    line.assign(static_cast<std::size_t>(beat.shape.samples), 0.0);
    for (int m = 0; m < beat.shape.chirps; ++m) {
      const std::complex<Real>* const row = &beat.at(static_cast<int>(channel), m, 0);
      const std::complex<double> phasor = over_chirps[static_cast<std::size_t>(m)];
      for (std::size_t n = 0; n < line.size(); ++n)
        add_product(line[n], static_cast<std::complex<double>>(row[n]), phasor);
    }
  });
  return lines;
}

// Per channel, a line over slow time.
template <typename Real>
ToneRecords fast_time_summed(const Cube<Real>& beat, const Line& over_samples) {
  ToneRecords lines(static_cast<std::size_t>(beat.shape.channels));
  core::parallel_for(lines.size(), [&](std::size_t channel) {
    Line& line = lines[channel];
    line.assign(static_cast<std::size_t>(beat.shape.chirps), 0.0);
    for (int m = 0; m < beat.shape.chirps; ++m) {
      const std::complex<Real>* const row = &beat.at(static_cast<int>(channel), m, 0);
      for (std::size_t n = 0; n < over_samples.size(); ++n)
        add_product(line[static_cast<std::size_t>(m)], static_cast<std::complex<double>>(row[n]),
                    over_samples[n]);
    }
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
