// Beats of a triangle's two ramps from their samples.
#pragma once

#include <complex>
#include <vector>

#include "signal/cube.h"
#include "signal/pairing/triangle.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::tracking {

struct Beat {
  double Hz = 0.0;
  double signal_to_noise = 0.0;                  // after one ramp, summed over the channels
  std::vector<std::complex<double>> amplitudes;  // of every channel
  int peak = 0;  // of the spectrum; two tones that make one peak share it
  // Of the plane wave that fits the amplitudes best, and whether it is all they hold; 0 and false where
  // nobody has looked.
  double azimuth_rad = 0.0;
  bool lone_wave = false;
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
// 1996), so that they do not pull each other. A peak near which a coarse stage saw something that
// moves at `coarse` speed is tried as two tones (signal/detection/two_tones.h), bent as that speed bends
// them. Neglected: that tones bend, elsewhere.
SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W,
                            const std::vector<signal::RangeSpeed>& coarse);

}  // namespace fanbeam::tracking
