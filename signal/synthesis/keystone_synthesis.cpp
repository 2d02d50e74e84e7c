#include "signal/synthesis/keystone_synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "signal/fourier/fft.h"
#include "signal/synthesis/beat_phase.h"
#include "signal/synthesis/keystone_transform_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kMostCells = 4e8;

void check_frame(const Frame& frame) {
  if (!frame.uniform)
    core::throw_input_error(core::ErrorClass::unsupported, "waveform",
                            std::string(name(frame.waveform.kind)), "a chirp sequence");
}

double mid_frame_s(const Frame& frame) {
  return 0.5 * (frame.segments.front().start_s + frame.segments.back().start_s) +
         (frame.shape.samples / 2) / frame.sample_rate_Hz;
}

std::vector<WavePoint> points_of(const KeystoneAxes& axes, const std::vector<KeystonePath>& paths) {
  std::vector<WavePoint> points;
  points.reserve(paths.size());
  for (const KeystonePath& path : paths)
    points.push_back({axes.rate.cell(path.rate), axes.sine_s_per_m.cell(path.sine_s_per_m),
                      path.delay_turns_per_sample * axes.delays, path.value});
  return points;
}

// Every row from delays to samples, in place: real parts first, imaginary parts after them.
void transform_delays(const SpreadingKernel& kernel, int samples, WaveGrid& grid) {
  const int delays = grid.delays();
  std::vector<float> scales;
  for (int n = 0; n < samples; ++n)
    scales.push_back(
        static_cast<float>(1.0 / kernel.transform(static_cast<double>(n - samples / 2) / delays)));
  const Fft<float> fft({delays, 1, 1, delays}, FftDirection::inverse);
  core::parallel_for(static_cast<std::size_t>(grid.rates()), [&](std::size_t rate) {
    std::vector<std::complex<float>> spectrum(static_cast<std::size_t>(delays));
    for (int sine = 0; sine < grid.sines(); ++sine) {
      std::complex<float>* row = grid.row(static_cast<int>(rate), sine);
      std::copy(row, row + delays, spectrum.begin());
      fft.run(spectrum.data());
      auto* parts = reinterpret_cast<float*>(row);
      for (int n = 0; n < samples; ++n) {
        const int k = n - samples / 2;
        const std::complex<float> value =
            spectrum[static_cast<std::size_t>(k < 0 ? k + delays : k)];
        parts[n] = value.real() * scales[static_cast<std::size_t>(n)];
        parts[delays + n] = value.imag() * scales[static_cast<std::size_t>(n)];
      }
    }
  });
}

// Of three axes, each with what the width gives, but not below the rounding of sums in float.
double kernel_error_of(int width) { return 3.0 * std::max(1e-6, spreading_error(width)); }

double error_of(const std::vector<KeystonePath>& paths, const SpreadingKernel& kernel) {
  double power = 0.0, missed = 0.0;
  for (const KeystonePath& path : paths) {
    power += std::norm(path.value);
    missed += std::norm(path.value) * path.error_rad * path.error_rad;
  }
  return power > 0.0 ? std::sqrt(missed / power) + kernel_error_of(kernel.width()) : 0.0;
}

// Fills the row's channels; the error is the largest of rows.
void add_row(const Frame& frame, const ElementRow& row, const std::vector<ScatterPath>& paths,
             const SpreadingKernel& kernel, KeystoneBeat& beat) {
  const std::vector<KeystonePath> seen = keystone_paths(frame, row, mid_frame_s(frame), paths);
  const KeystoneAxes axes = keystone_axes(frame, seen, kernel.width(), mid_frame_s(frame));
  const double cells = static_cast<double>(axes.rate.cells) * axes.sine_s_per_m.cells * axes.delays;
  if (cells > kMostCells)
    core::throw_input_error(
        core::ErrorClass::limit, "grid cells", cells,
        "at most 4e8: fewer chirps, transmitters or receivers, a shorter ramp or interval, or a "
        "narrower span of speeds");
  // Not before: what is refused takes no memory.
  if (beat.cube.values.empty()) beat.cube = FloatCube(frame.shape);
  beat.estimated_error = std::max(beat.estimated_error, error_of(seen, kernel));
  WaveGrid grid(kernel, axes.rate.cells, axes.sine_s_per_m.cells, axes.delays);
  grid.spread(points_of(axes, seen));
  transform_delays(kernel, frame.shape.samples, grid);
  transform_rates_and_sines(frame, row.channels, axes, kernel, grid, beat.cube);
}

}  // namespace

KeystoneBeat keystone_beat(const Waveform& waveform, int stage, const Array& array,
                           const std::vector<ScatterPath>& paths, const KeystoneOptions& options) {
  if (!(options.kernel_error >= 1e-5 && options.kernel_error <= 1e-2))
    core::throw_input_error(core::ErrorClass::range, "kernel_error", options.kernel_error,
                            "1e-5 to 1e-2");
  const Frame frame = make_frame(waveform, stage, array);
  check_frame(frame);
  check(waveform, paths);
  KeystoneBeat beat;
  if (paths.empty()) {
    beat.cube = FloatCube(frame.shape);
    return beat;
  }

  const SpreadingKernel kernel(std::min(8, kernel_width(options.kernel_error)));
  for (const ElementRow& row : element_rows(frame)) add_row(frame, row, paths, kernel, beat);
  if (!waveform.complex_baseband) keep_real(beat.cube);
  return beat;
}

}  // namespace fanbeam::signal
