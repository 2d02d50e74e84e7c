// Beats of a triangle's two ramps from their samples.
#pragma once

#include <complex>
#include <vector>

#include "signal/cube.h"
#include "signal/pairing/triangle.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::tracking {

struct Beat {
  double Hz = 0.0, sigma_Hz = 0.0;
  double signal_to_noise = 0.0;                  // after one ramp, summed over the channels
  std::vector<std::complex<double>> amplitudes;  // of every channel
  double amplitude_noise_ratio = 1.0;            // over that of a lone beat (tone_bound.h)
  int peak = 0;  // of the spectrum; two tones that make one peak share it
  // Of the plane wave that fits the amplitudes best, and whether it is all they hold; 0 and false where
  // nobody has looked.
  double azimuth_rad = 0.0, azimuth_sigma_rad = 0.0;
  bool lone_wave = false;
};

struct SampledBeats {
  std::vector<Beat> up, down;
};

// `samples`: two chirps, up and down, of any number of channels; `noise_W` of one sample of one
// channel. Peaks of the spectrum under a Chebyshev window of -60 dB, summed over the channels, 13 dB
// above the noise of one and at most 55 dB below the strongest; sharper by maximum likelihood, without
// window where each ramp has one peak. Tones are sought in turn, each bent as the speed of the nearest
// `coarse` place bends it (bent_tones.h). A peak near which there is one, and two peaks within 2.4
// bins, are tried as two tones (signal/detection/two_tones.h), of one bend: what another one's differs
// is in sigma_Hz. Peaks that no coarse place explains are kept if they are more than what those leave.
// Deviations told: signal/detection/tone_bound.h.
SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W,
                            const std::vector<signal::RangeSpeed>& coarse);

}  // namespace fanbeam::tracking
