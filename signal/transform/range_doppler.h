// Range and Doppler transforms of a beat cube: fast time becomes range, slow time Doppler.
//
//   Y[r, d, c] = 1 / (sum w sum u) sum over n, m of w[n] u[m] x[n, m, c]
//                exp(-j 2 pi (r n / N + (d - D0) m / M)),   D0 = floor(M / 2)
//
// N and M are the transform lengths, w and u the windows. A lone tone on a cell keeps its power,
// |Y|^2 = |amplitude|^2; white noise of variance s2 per sample leaves
// s2 (sum w^2 / (sum w)^2) (sum u^2 / (sum u)^2) per cell (`noise_gain`), correlated between
// neighbouring cells as the windows demand (signal/detection/cfar_calibration.h). Doppler cells run
// from the lowest (closing) to the highest (receding); cell D0 is rest.
//
// Inputs: a cube of at least one value whose memory fits its shape; transform lengths of at least
// the input's, 0 for as long as the input; windows as in signal/fourier/window.h. E-RANGE
// otherwise. Neglected: range migration within the frame, and the shift of the beat by Doppler, fc
// v / S in range, which the reader of a cell knows from its Doppler (`RangeDopplerAxes::range_m`).
// Accuracy: relative 1e-6 (float), 1e-14 (double) of the largest value. Cost: one pass over the
// cube for each axis, channel by channel so that both find it in the cache: 1.4 times the
// bare transforms of as many neighbouring values (benchmarks/signal_cube.cpp, docs/fmcw.md). Channels run on the
// loop of core/parallel.h, and the bits do not depend on the threads. `result` keeps its memory
// between calls of one shape.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/fourier/window.h"

namespace fanbeam::signal {

struct RangeDopplerSettings {
  Window range_window{.kind = WindowKind::taylor};
  Window doppler_window{.kind = WindowKind::taylor};
  int range_length = 0;  // of the transforms; 0: no padding
  int doppler_length = 0;
  int kept_range_cells = 0;  // the nearest ones; 0: all
};

// Of the transformed cube.
CubeShape range_doppler_shape(const CubeShape& beat, const RangeDopplerSettings& settings);

template <typename Real>
void range_doppler(const Cube<Real>& beat, const RangeDopplerSettings& settings,
                   Cube<Real>& result);

// sum w^2 / (sum w)^2: noise power in a cell over that in a sample.
double noise_gain(const std::vector<double>& weights);

// What the cells of a transformed cube mean.
struct RangeDopplerAxes {
  double range_step_m = 0.0;           // c fs / (2 S N)
  double doppler_step_Hz = 0.0;        // 1 / (M T)
  double wavelength_m = 0.0;           // at the centre of the sweep
  double range_per_Doppler_m_s = 0.0;  // c / (2 S): metres read too long per hertz of Doppler
  int doppler_cells = 0;

  // Cells may be fractional. Doppler is positive receding and within +-1 / (2 T).
  double doppler_Hz(double doppler_cell) const {
    return (doppler_cell - static_cast<double>(doppler_cells / 2)) * doppler_step_Hz;
  }
  double speed_mps(double doppler_cell) const {
    return 0.5 * wavelength_m * doppler_Hz(doppler_cell);
  }
  // With the shift by Doppler taken off; at the middle of the frame's mean chirp.
  double range_m(double range_cell, double doppler_at_cell_Hz) const {
    return range_cell * range_step_m - range_per_Doppler_m_s * doppler_at_cell_Hz;
  }
};

// `repetition_s` is the time from one chirp of a transmitter to its next. Needs positive, finite
// values and positive lengths; E-RANGE otherwise. A falling sweep is for the caller to mirror.
RangeDopplerAxes range_doppler_axes(double sample_rate_Hz, double slope_Hz_per_s,
                                    double repetition_s, double wavelength_m, int range_length,
                                    int doppler_length);

}  // namespace fanbeam::signal
