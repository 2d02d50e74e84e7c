// Beats of a triangle's two ramps from their samples.
#pragma once

#include "signal/cube.h"
#include "signal/pairing/triangle.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::tracking {

struct Beat {
  double Hz = 0.0;
  double signal_to_noise = 0.0;  // after one ramp, summed over the channels
};

struct SampledBeats {
  std::vector<Beat> up, down;
  // Variance of a beat over that of an unweighted one: 1 where one is alone, else the window's.
  double variance_ratio = 1.0;
};

// `samples`: two chirps, up and down, of any number of channels; `noise_W` of one sample of one
// channel. Peaks of the spectrum under a Chebyshev window of -60 dB, summed over the channels, 13 dB
// above the noise of one and at most 55 dB below the strongest; sharper by maximum likelihood,
// without window where each ramp has one peak. Tones whose peaks are within three bins are sought in
// turn, each in what the others leave of the samples (RELAX; J. Li, P. Stoica, IEEE Trans. SP-44,
// 1996), so that they do not pull each other. Neglected: that tones bend over a ramp; two tones that
// make one peak stay one.
SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W);

}  // namespace fanbeam::tracking
