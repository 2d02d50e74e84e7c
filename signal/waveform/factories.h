// The nine kinds of waveform from their usual parameters.
//
// The defaults are the reference radar: 76 GHz, 250 MHz, ramps of 2 ms or chirps of 20 us.
// The clock's zero, to which the range of a ScatterPath belongs: the start of the frame, but of
// kinds with a triangle the (first) triangle's turnaround, because that is where a pair of beats
// measures the range (pairing/triangle.h).
// Every function refuses, with the field's name, values that are not finite (E-NONFINITE), not
// positive, or not below each other as stated (E-RANGE); and whatever check(Waveform) refuses.
// Sources: chirp sequence and triangle: A. G. Stove, IEE Proc. F 139(5), 1992; two slopes and two
// stages: E. Hyun, W. Oh, J.-H. Lee, "Multi-target detection algorithm for FMCW radar", IEEE Radar
// Conference 2012; coded flat stretch: Y. Fan, K. Xiang, J. An, X. Bu, 2013; MFSK: H. Rohling,
// M.-M. Meinecke, "Waveform design principles for automotive radar systems", CIE Radar 2001.
#pragma once

#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct ContinuousParameters {
  double frequency_Hz = 76e9;
  double duration_s = 20e-3;
  double sample_rate_Hz = 100e3;
  bool complex_baseband = true;
};
Waveform continuous(const ContinuousParameters& parameters);

struct PulsedParameters {
  double frequency_Hz = 76e9;
  double pulse_width_s = 10e-9;  // below the interval
  double interval_s = 10e-6;
  int pulses = 64;
  double sample_rate_Hz = 200e6;
};
Waveform pulsed(const PulsedParameters& parameters);

struct ChirpSequenceParameters {
  double frequency_Hz = 76e9;   // at the middle of a ramp
  double bandwidth_Hz = 250e6;  // below the frequency
  double ramp_s = 20e-6;
  double interval_s = 20e-6;  // from ramp to ramp; at least ramp_s
  int chirps = 256;           // of each transmitter
  int slots = 1;              // transmitters in turn
  double sample_rate_Hz = 20e6;
  bool complex_baseband = true;
};
Waveform chirp_sequence(const ChirpSequenceParameters& parameters);

struct TriangleParameters {
  double frequency_Hz = 76e9;
  double bandwidth_Hz = 250e6;
  double ramp_s = 2e-3;
  bool down_first = false;
  double sample_rate_Hz = 500e3;
  bool complex_baseband = true;
};
Waveform triangle(const TriangleParameters& parameters);

struct SinusoidalParameters {
  double frequency_Hz = 76e9;
  double deviation_Hz = 250e6;  // peak to peak, below the frequency
  double modulation_Hz = 500.0;
  int periods = 1;
  double sample_rate_Hz = 2e6;
  bool complex_baseband = true;
};
Waveform sinusoidal(const SinusoidalParameters& parameters);

// Two triangles, one after the other; the second with its own ramp time.
struct TwoSlopesParameters {
  TriangleParameters first;
  double second_ramp_s = 3e-3;  // differs from the first
};
Waveform two_slopes(const TwoSlopesParameters& parameters);

// A chirp sequence, and the triangle at once after it.
struct TwoStageParameters {
  ChirpSequenceParameters coarse;
  TriangleParameters fine;
};
Waveform two_stage(const TwoStageParameters& parameters);

// Ramp up, a flat stretch at the upper frequency that hops between f and f - hop_Hz by an
// m-sequence, ramp down. Zero of the clock: the middle of the flat stretch.
struct CodedTriangleParameters {
  TriangleParameters ramps;  // down_first is refused
  double flat_s = 2e-3;
  double hop_Hz = 700e3;
  int code_degree = 7;  // 2^7 - 1 = 127 chips; 3 to 12
};
Waveform coded_triangle(const CodedTriangleParameters& parameters);

// Two staircases of frequency, interleaved: A_1 B_1 A_2 B_2 ..., B a shift below or above A.
struct SteppedParameters {
  double frequency_Hz = 76e9;  // middle of staircase A
  double bandwidth_Hz =
      250e6;  // that its steps fill, each B / steps wide: the range cell is c / 2B
  double shift_Hz = -488.28e3;  // of B against A; not 0
  int steps = 256;              // of each staircase; at least 2
  double step_s = 10e-6;
  double sample_rate_Hz = 1e6;
};
Waveform stepped(const SteppedParameters& parameters);

}  // namespace fanbeam::signal
