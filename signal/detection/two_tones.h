// Two tones that make one peak, by joint maximum likelihood over several records.
//
//   x_c[n] = A_c exp(j 2 pi b n / N) + B_c exp(j 2 pi d n / N) + noise, n counted as in tone.h
//
// With the amplitudes eliminated the pair of places explains, summed over the records,
//   E(b, d) = (|p|^2 + |q|^2 - 2 Re(conj(p) q rho)) / (N (1 - |rho|^2)),
// p and q the sums of the record at the two places, rho = the mean of exp(j 2 pi (d - b) n / N). It is
// sought on a grid of a tenth of a bin within 1.6 bins of the peak, of the middle of the two where one
// is at the edge of that, and finer about its best place, down to 2.4e-5 bins.
// Two rather than one: E is larger than one tone's by more than noise gives (C records of variance s2:
// s2 (C + 6 sqrt(C) + 20), in less than one of a million) and by more than 1e-4 of it, which is what
// side lobes and bent tones leave; they are `least_apart_bins` apart or more, and the weaker has a
// three-hundredth of the power.
// Source: S. M. Kay, "Fundamentals of Statistical Signal Processing" I, 1993, 7.4 and 13. Inputs: as of
// refined_tone, without weights; `curvature` bends all tones alike, which is taken off: the frequency
// grows by so many bins from the first sample to the last. Accuracy above threshold: the Cramer-Rao
// bound of two tones.
// Cost: five sums over the samples of all records where a peak is one tone, some 200 where it is not.
#pragma once

#include <optional>
#include <utility>

#include "signal/detection/tone.h"

namespace fanbeam::signal {

std::optional<std::pair<Tone, Tone>> two_tones(const ToneRecords& records, double near_bin,
                                               double curvature_bins, double noise_W,
                                               double least_apart_bins = 1.0 / 3.0);

}  // namespace fanbeam::signal
