// Beat signals of many paths, fast and to a stated error.
//
// Uniform frames of linear segments (a chirp sequence): a type-1 non-uniform Fourier transform over
// range (spreading_kernel.h), for every chirp and channel with the path's own place and phase:
//   * delay, Doppler and near field per element are exact; migration through range cells costs
//     nothing, because every chirp spreads at its own place;
//   * the bend of a beat over its ramp, 2 pi S tau' t^2, goes to first order into the kernel, by its
//     second derivative; where that is not enough it is a series of as many terms as it takes;
//   * paths for which the low polynomials would miss the error (very near, very fast) go the way
//     below.
// Anything else that is linear or flat (triangles, steps, a coded flat stretch), and frames of few
// paths: the quadratic phase of every ramp by products in double, error below 1e-8.
// Sinusoidal and pulsed: as reference_beat.
//
// Error: relative L2 difference from reference_beat at most `relative_error`. Down to 1e-5 the
// arithmetic is float, below it is double. Allowed: 1e-10 to 1e-2; E-RANGE otherwise. A float
// result is rounded to 6e-8 at the end.
// Cost: 1000 paths into 400 x 256 x 12 samples take about 45 ms on one thread with AVX2, seven times
// that to 1e-6 (docs/fmcw.md). It grows with paths x chirps x channels, plus the transforms. Above some 20 000
// paths see keystone_synthesis.h.
// The same bits for any number of threads. Sums in the order of the paths.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/scatter_path.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct SynthesisOptions {
  double relative_error = 1e-4;
};

FloatCube synthesise_beat(const Waveform& waveform, int stage, const Array& array,
                          const std::vector<ScatterPath>& paths,
                          const SynthesisOptions& options = {});
DoubleCube synthesise_beat_double(const Waveform& waveform, int stage, const Array& array,
                                  const std::vector<ScatterPath>& paths,
                                  const SynthesisOptions& options = {});

}  // namespace fanbeam::signal
