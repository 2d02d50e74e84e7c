// What the bounds of the signal level may use of one set of samples (signal_effects.h).
#pragma once

namespace fanbeam::renderer {

struct SignalFacts {
  // How what is made of the samples is shown.
  double window_dB = 60.0;     // of the picture, grey 0 to 255
  bool samples_asked = false;  // the samples are a product themselves
  int beams = 1;               // channels that a beam sums coherently, most of all products
  // The samples as they reach the receiver.
  double echo_W = 0.0;                // sum of the echoes' powers at one receiver's port
  double largest_sample_sqrtW = 0.0;  // largest magnitude of any part of any sample
  // What other radars' chirps put into a frame's samples: the sum of the complex samples' powers, of
  // the channel that hears most.
  double interference_W = 0.0;
  // The receiver.
  double noise_sample_W = 0.0;   // thermal noise of a complex sample, both parts
  bool complex_baseband = true;  // else real samples
  double phase_noise_rad = 0.0;  // rms, at most of any echo; 0: the oscillator has none
  // Largest density of that phase at any offset, times the sample rate: 1 rms^2 where it is white.
  double phase_noise_peak = 0.0;
  int adc_bits = 0;  // 0: no quantiser
  double full_scale_sqrtW =
      0.0;  // of the quantiser; 0: the largest part of any sample, noise included
};

}  // namespace fanbeam::renderer
