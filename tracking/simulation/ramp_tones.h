// The tones of one ramp, as many as its peaks and the coarse stage call for.
//
// Tones are sought in turn (bent_tones.h), each bent as the speed of the nearest coarse place within
// 2.5 bins bends it. A peak near such a place, and two peaks within 2.4 bins, are tried as two tones by
// joint maximum likelihood (signal/detection/two_tones.h), of one bend; what stands within six bins of
// two is sought again beside them. Two peaks within 0.3 bins that are not two are one. A peak that no
// coarse place explains and that is 30 dB weaker than one within 12 bins that is explained may be a
// side lobe of two taken for one: it is left aside until those are found, and kept if what is left of
// it is still a peak.
// Neglected: more than two tones within 2.4 bins, taken pair by pair, the nearest first.
#pragma once

#include <vector>

#include "signal/detection/tone.h"
#include "tracking/simulation/bent_tones.h"

namespace fanbeam::tracking {

// How far from a coarse place a tone may be that is its target's.
inline constexpr double kSeenReach_bins = 2.5;

struct RampTone {
  BentTone bent;
  int peak = 0;              // two tones that make one peak share it
  bool jointly = false;      // with the one before or after it, without a window
  double other_bends = 0.0;  // bins that the other one bends more or less, which that does not know
};

// `bins`: peaks. `seen`: where the coarse stage has something, and how that bends. `least_power`: of a
// tone, as BentTone has it. `weights` as of refined_tone.
std::vector<RampTone> ramp_tones(const signal::ToneRecords& records,
                                 const std::vector<double>& bins, const std::vector<BentPeak>& seen,
                                 const std::vector<double>& weights, double noise_W,
                                 double least_power);

}  // namespace fanbeam::tracking
