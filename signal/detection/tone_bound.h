// How well the places of tones that share records can be known: the Cramer-Rao bound.
//
//   x_c[n] = sum_i A_ic exp(j 2 pi b_i n / N) + noise of variance s2, all A_ic and b_i unknown
//
// With a_i the samples of tone i about the middle one, d_i their derivative by b_i, P the projection on
// what no tone explains and S_ij = sum_c conj(A_ic) A_jc,
//   cov(b) = s2 / 2 (Re((d_i^H P d_j) S_ij))^-1 .
// One tone: var b = 6 / (4 pi^2 eta) N^2 / (N^2 - 1), eta = N sum_c |A_c|^2 / s2. Two equal ones a bin
// apart, in quadrature: 1 / (1 - 3 / pi^2) = 1.44 times that; in phase 6.1 times, and half a bin apart
// 5.8 and 89 times. The noise of an amplitude over a lone tone's is N (A^H A)^-1_ii for places that are
// known, and what wrong places bring of the other tones' amplitudes, ((A^H A)^-1 A^H D)_ij^2 var b_j
// |A_j|^2 N / s2, as if all of it lay in one direction of the records.
// Source: P. Stoica, A. Nehorai, IEEE Trans. ASSP-37, 1989, deterministic signals. Tones farther apart
// than 6 bins are taken for alone, which leaves out 3 % at most for each other one.
// Inputs: amplitudes at sample 0 (tone.h), of as many records each; two samples or more; noise_W 0 or
// more. E-RANGE, E-NONFINITE otherwise. A place that cannot be told (another one's within 1e-3 bins, no
// power) has infinite variance. Cost: the square of the tones within 6 bins, times the samples; nothing
// for tones alone.
#pragma once

#include <cstddef>
#include <vector>

#include "signal/detection/tone.h"

namespace fanbeam::signal {

struct ToneBound {
  double variance_bins2 = 0.0;
  double amplitude_noise_ratio = 1.0;  // of power
};
// One for each tone.
std::vector<ToneBound> tone_bounds(const std::vector<Tone>& tones, std::size_t samples,
                                   double noise_W);

}  // namespace fanbeam::signal
