// Beats of a triangle's two ramps from their samples.
#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <vector>

#include "signal/cube.h"
#include "signal/pairing/triangle.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::tracking {

struct Beat {
  double Hz = 0.0, sigma_Hz = 0.0;
  double settled_bins = 0.0;     // what taking turns with neighbours leaves where it ends
  double signal_to_noise = 0.0;  // after one ramp, summed over the channels
  std::vector<std::complex<double>> amplitudes;  // of every channel
  double amplitude_noise_ratio = 1.0;            // over that of a lone beat (tone_bound.h)
  int peak = 0;  // of the spectrum; two tones that make one peak share it
  // Of the plane wave that fits the amplitudes best, and whether it is all they hold; 0 and false of one
  // receiver.
  double azimuth_rad = 0.0, azimuth_sigma_rad = 0.0;
  bool lone_wave = false;
};

struct SampledBeats {
  std::vector<Beat> up, down;
};

// The receivers, along y.
struct ReceiverLine {
  std::vector<glm::dvec3> elements_m;
  double wavelength_m = 0.0, pitch_wavelengths = 0.0;
  double beam_sine = 0.0;  // between half powers
};

// `samples`: two chirps, up and down, of any number of channels; `noise_W` of one sample of one
// channel. Peaks of the spectrum under a Chebyshev window of 60 dB in its periodic form, whose highest side
// lobes lie at -56.6 dB (1024 samples), summed over the channels, as much
// above the mean noise as 13 dB are of one channel (8.3 dB of twelve), and at most 55 dB below the
// strongest; sharper by maximum likelihood, without window where each ramp has one peak. Which tones
// they are: ramp_tones.h, bent as the speeds of `coarse` places bend them; what bends differ within two
// tones of one peak is in sigma_Hz. Deviations told: signal/detection/tone_bound.h. A tone of two plane waves is
// two beats: beat_waves.h.
SampledBeats triangle_beats(const signal::FloatCube& samples, const signal::TriangleModel& model,
                            double sample_rate_Hz, double noise_W,
                            const std::vector<signal::RangeSpeed>& coarse,
                            const ReceiverLine& line);

}  // namespace fanbeam::tracking
