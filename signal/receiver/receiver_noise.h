// What a receiver adds to a beat signal: thermal noise and quantisation (phase noise: oscillator.h).
//
// Thermal noise is white in time: complex Gaussian of variance k T0 F fs per complex sample (real
// Gaussian of k T0 F fs / 2 per real one), each virtual channel's its own: in time division by time,
// and orthogonal codes of simultaneous transmitters leave E[y_i y_k*] = sigma^2 sum c_i c_k* = 0. Windows and transforms correlate it afterwards as they do in a radar; it
// is never added to spectra.
//
// The quantiser rounds real and imaginary part to steps of full_scale / 2^(bits - 1), and clips to
// [-full_scale, full_scale - step].
//
// Draws are pure functions of seed, frame and cell (core/random_normals.h, of float accuracy: what
// that leaves out is 120 dB below the noise); the key's stream is set here.
// Same bits for any number of threads.
#pragma once

#include <cstddef>

#include "core/random.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {

// k T0 F fs; noise figure as a power ratio of 1 or more.
double noise_sample_W(double noise_figure, double sample_rate_Hz);

struct ReceiverNoise {
  double sample_W = 0.0;         // noise_sample_W; 0 adds nothing
  bool complex_baseband = true;  // else half of it, in the real part
  core::RandomKey key;
};

// The cube's channels are those of the array; E-RANGE otherwise.
template <typename Real>
void add_receiver_noise(const Array& array, const ReceiverNoise& noise, Cube<Real>& cube);

struct Quantiser {
  int bits = 12;                  // 1 to 24
  double full_scale_sqrtW = 0.0;  // above 0
};

// Returns how many parts of samples were clipped.
template <typename Real>
std::size_t quantise(const Quantiser& quantiser, Cube<Real>& cube);

extern template void add_receiver_noise(const Array&, const ReceiverNoise&, FloatCube&);
extern template void add_receiver_noise(const Array&, const ReceiverNoise&, DoubleCube&);
extern template std::size_t quantise(const Quantiser&, FloatCube&);
extern template std::size_t quantise(const Quantiser&, DoubleCube&);

}  // namespace fanbeam::signal
