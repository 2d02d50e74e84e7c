// The directions that a ramp's beats come from, and beats of two directions as two.
//
// Two targets within a third of a bin of each other make one tone to any receiver, and so do two that are farther apart
// while their phases hide it (ramp_tones.h). An array sees two waves:
//   x_c(t) = sum_i A_i exp(j 2 pi (b_i t + c_i t^2 / 2 + p_c(s_i) (1 + w t))) + noise,   t from -1/2 to 1/2 over the ramp,
//   p_c(s) = -s y_c / lambda + y_c^2 (1 - s^2) / (2 R lambda),
// c over the channels, w the sweep over the mean frequency, s the sine of the azimuth, and the range R and the bends c_i
// known to the coarse stage. A_i, b_i and s_i of both are sought at once, by Gauss and Newton, from where the tone's
// amplitudes have their directions (directions.h), in what the other tones leave of the samples: maximum likelihood, and
// the Cramer-Rao bound of all eight is what is told. Where the coarse stage has two speeds there, each wave has the bend
// that leaves less. Two tones that were sought jointly and are one wave each are sought again so.
// Without w, 250 MHz of 76.5 GHz, which are 0.05 rad at the edge of twelve receivers, beats are off by up to 0.002 bins
// (1 mm); without the wave's curvature, 0.002 rad there at 50 m, directions by 0.2 mrad half of c / (N d) apart. The rest
// is noise up to 70 dB, from kLeastDirections on (tests/tracking/beat_waves_test.cpp).
// Source: S. M. Kay, "Fundamentals of Statistical Signal Processing" I, 1993, 7.7 and 3.9.
// Neglected: three waves of one tone; what two waves nearer than that look like where they are in phase, one wave between
// them.
#pragma once

#include <vector>

#include "signal/detection/tone.h"
#include "tracking/simulation/ramp_tones.h"
#include "tracking/simulation/triangle_beats.h"

namespace fanbeam::tracking {

// What the coarse stage has within 2.5 bins of a tone: the range of the nearest, infinite for none, and how much they bend.
struct NearPlaces {
  double range_m = 0.0, least_bend_bins = 0.0, most_bend_bins = 0.0;
};

// What a ramp's tones were sought in, and how (ramp_tones.h).
struct SoughtRamp {
  const signal::ToneRecords& records;
  const std::vector<RampTone>& tones;
  double noise_W, bin_Hz;
  double sweep;  // what the frequency grows by over the samples, over the mean
  // Of each tone; what else than noise leaves its place unsure.
  std::vector<NearPlaces> near;
  std::vector<double> unknown_bins;
};

// `beats`: of the tones, in their order. Those of one receiver stay as they are.
std::vector<Beat> by_direction(const SoughtRamp& ramp, const ReceiverLine& line,
                               std::vector<Beat> beats);

}  // namespace fanbeam::tracking
