// What goes into a mixer and what comes out, over one segment of a waveform and one echo.
//
//   transmitted  s(t) = cos phi_s(t)
//   received     r(t) = cos(phi_s(t) - phi_b(t))        phi_b the beat phase of beat_phase.h, exact
//   product      s r = (cos phi_b + cos(2 phi_s - phi_b)) / 2
//   beat         the product behind a low pass: cos(phi_b) / 2, sampled at the waveform's rate, or at twice
//                that where its samples are complex: they hold beats up to their rate
// 76 GHz cannot be shown: phi_s begins at a carrier of 1.5 sweeps less half a sweep instead, which changes
// neither phi_b nor that the sum lies above it (from twice the sweep less the beat on). The low pass is a
// Kaiser-windowed sinc, 100 dB down from there, flat to 1e-5 below half the trace's rate.
// Source: M. I. Skolnik, Introduction to Radar Systems, 3rd ed., 2001, ch. 3.
// Inputs: a stage of ramps or steps, not pulsed, sinusoidal or of one tone (E-UNSUPPORTED); an echo
// that the waveform's check takes; a sweep and an echo whose sum stays clear of half the trace's rate
// (E-RANGE); at most 3e7 samples of the product (E-LIMIT: a shorter ramp or a smaller sweep).
// Neglected: noise, leakage, the mixer's imbalance.
#pragma once

#include <vector>

#include "signal/scatter_path.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct MixerTrace {
  double carrier_Hz = 0.0;  // where the transmitted signal is shown, at the middle of its sweep
  double step_s = 0.0;      // of the three below, from the segment's start
  std::vector<double> transmitted, received, product;
  double sample_s = 0.0;     // of the beat
  std::vector<double> beat;  // of amplitude 1/2
};

MixerTrace mixer_trace(const Waveform& waveform, const ScatterPath& echo);

}  // namespace fanbeam::signal
