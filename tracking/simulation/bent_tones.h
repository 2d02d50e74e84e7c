// Beats of moving targets as tones whose frequency grows over the ramp, several in the same samples.
//
//   x_c[n] = sum_i A_ic exp(j 2 pi (b_i n / N + c_i t^2 / 2)) + noise,  t = (n - (N - 1) / 2) / N
//
// with the bend c_i in bins over the ramp, known (a target's speed gives it), places and amplitudes
// not. Sought in turn, each straightened in what the others leave (J. Li, P. Stoica, IEEE Trans. SP-44,
// 1996), until none moves by 1e-4 bins any more; farther than 3.5 bins from every other peak once is
// enough. Otherwise main lobes that touch pull by tenths of a bin, and side lobes of a tone that is ten
// times as strong by a hundredth. Tones nearer than two bins may not get there in the twelve turns there
// are, which they tell.
#pragma once

#include <vector>

#include "signal/detection/tone.h"

namespace fanbeam::tracking {

// Taking turns ends where none moves by more: 0.06 mm of 250 MHz.
inline constexpr double kStill_bins = 1e-4;
// Within which main lobes overlap. Beyond, side lobes alone pull, and one turn takes that off to a thousandth.
inline constexpr double kTouching_bins = 3.5;

struct BentPeak {
  double bin = 0.0, curvature_bins = 0.0;
};

struct BentTone {
  signal::Tone tone;  // without the bend, which has no phase in the middle
  double curvature_bins = 0.0;
  double unsettled_bins = 0.0;  // how far it may still be from its place: ten times its last move
  bool lost = false;            // its peak has no tone of its own
};

// Bins of 0 and of `count` are one.
double bins_apart(double a, double b, double count);

// `times` -1 takes it away.
void add(const BentTone& bent, double times, signal::ToneRecords& records);

// One for each peak, in the same order. A tone that leaves its peak by more than a bin is lost: what is
// there is the others'. `weights` as of refined_tone.
std::vector<BentTone> tones_in_turn(const signal::ToneRecords& records,
                                    const std::vector<BentPeak>& peaks,
                                    const std::vector<double>& weights);

}  // namespace fanbeam::tracking
