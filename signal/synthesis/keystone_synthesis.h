// Beat signals of very many paths (a million): cost per path independent of the cube.
//
// In a uniform frame seen by virtual elements in a row to the right, the beat's phase is, with f
// the transmitted frequency at a sample, t its time, d the place of the element in the row, u the
// direction's part to the right,
//   2 pi f (tau + w t - U d) + terms of tau alone,   w = tau' k, U = k u / c, k = 1 - S tau / fc,
// tau being the delay to and from the row's middle: rows at other heights, or before each other,
// are done one after the other.
// a Fourier integral over (tau, w, U) whose second and third variable scale with f. Range migration
// and the drift of angle over the ramp are nothing but this scale. So:
//   1. every path is spread over W^3 cells of an even grid of (tau, w, U) (spreading_kernel.h);
//   2. the delay is transformed to samples;
//   3. for every sample, U is summed to elements and w is transformed to chirps with that sample's
//      own scale (chirp-z transform), and the kernel is taken out.
// Source of 3: L. R. Rabiner, R. W. Schafer, C. M. Rader, Bell Syst. Tech. J. 48, 1969; the scale
// is that of the keystone transform, R. P. Perry et al., IEEE Trans. AES 35, 1999.
//
// Neglected, and estimated for every path: the near field beyond first order,
// 2 pi q / (2 lambda R), q the squares of the two elements across the direction, about its mean over
// the row (2.8 mrad at 20 m for the default array);
// (tau - its value at mid frame)^2; the change of k over the ramp. Speeds are taken at mid frame.
// Error: relative L2 against reference_beat, for paths of independent phases, at most
// `estimated_error`: the root mean square of those estimates over the power, plus three times that
// of the kernel, once for each axis.
// Cost: for every row W^3 cells per path, plus transforms that depend on the span of speeds and angles. One
// million paths into 400 x 256 x 12 take about a second of processor time, shared by all threads
// (docs/fmcw.md). Same bits for any number
// of threads.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/scatter_path.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct KeystoneOptions {
  double kernel_error = 1e-3;  // 1e-5 to 1e-2: chooses the width, 6 down to 3e-5, else 8 or 4
};

struct KeystoneBeat {
  FloatCube cube;
  double estimated_error = 0.0;
};

// E-UNSUPPORTED: a frame that is not uniform.
// E-LIMIT: more than 4e8 grid cells (a span of speeds far beyond the unambiguous one).
KeystoneBeat keystone_beat(const Waveform& waveform, int stage, const Array& array,
                           const std::vector<ScatterPath>& paths,
                           const KeystoneOptions& options = {});

}  // namespace fanbeam::signal
