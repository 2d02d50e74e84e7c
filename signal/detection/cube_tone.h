// Range and Doppler of one scatterer from the beat cube itself, to the Cramer-Rao bound, and its
// snapshot over the channels.
//
//   x[n, m, c] = s_c exp(j 2 pi (b n / N + d m / M)) + noise
//
// The place (b, d) is climbed along range with slow time summed at the current Doppler, then along
// Doppler with fast time summed at the current range, and again: with time counted from the middle
// the two bounds do not interact, so two rounds reach the joint maximum-likelihood place. Powers
// are added over channels, whose phases need not be known. With all weights 1:
//   sigma_b = sigma_d = sqrt(6 / eta) / (2 pi),  eta = N M sum |s_c|^2 / s2.
// Weights as in signal/detection/tone.h, for when other scatterers are within some ten cells in
// both range and Doppler.
//
// Inputs: a cube with two samples and two chirps or more; start within half a bin (bins of unpadded
// transforms, Doppler from 0 at rest, negative closing). E-RANGE otherwise. Neglected: migration
// through range cells within the frame; the range found is that at the middle of the frame.
// Cost: four passes over the cube, 15 ms of one thread for 512 x 256 x 16.
#pragma once

#include <complex>
#include <vector>

#include "signal/cube.h"

namespace fanbeam::signal {

struct CubeTone {
  double range_bin = 0.0;
  double doppler_bin = 0.0;                    // 0 at rest
  std::vector<std::complex<double>> snapshot;  // s_c at the middle of the frame and chirp
};

struct ToneWeights {
  std::vector<double> samples;  // none: all 1
  std::vector<double> chirps;
};

template <typename Real>
CubeTone refined_in_cube(const Cube<Real>& beat, double range_bin, double doppler_bin,
                         const ToneWeights& weights = {});

}  // namespace fanbeam::signal
