// Beats of other radars' chirps in a receiver of this one.
//
// The mixer multiplies whatever comes in with the own transmitted signal. Of an interferer's chirp, which
// began at its antenna at time T with frequency g0 and slope Q, the receiver hears, transmitted minus
// received phase as of beat_phase.h,
//   phi(t) = 2 pi [f0 t' + S t'^2 / 2 + f0 t_s] - 2 pi [g0 t'' + Q t''^2 / 2 + g0 T] ,
//   t' = t - t_s since the own segment began, t'' = t - T - |x - p_r| / c ,  x = (R + v t) u .
// The brackets' last terms let either radar's chirps begin with the phase of a clock of its own: chirps
// of one interval and slope add up over the frame to a ghost, all others to noise. The beat's frequency
// f_v - f_i sweeps with S - Q through the receiver's band and leaves the rest of the chirp alone. The
// low pass before the converter is a Butterworth's of order 8, its corner at 0.45 of the sample rate,
// taken at the momentary frequency:
//   |H|^2 = 1 / (1 + (f / corner)^16) ,
// so that a crossing of power P brings the energy P 2 corner 1.0065 / |S - Q| (1.0065 = (pi/16) / sin(pi/16)).
// Source: G. M. Brooker, "Mutual interference of millimeter-wave radar systems", IEEE Trans. EMC-49,
// 2007.
// Neglected: the low pass' ringing where the beat sweeps quickly, saturation before it (the
// quantiser's comes after), echoes of the interferer from other bodies, its modulation in phase.
// Inputs: see the struct; E-RANGE, E-NONFINITE otherwise; E-UNSUPPORTED for pulsed and sinusoidal
// waveforms; E-LIMIT beyond a hundred million crossings of chirps.
// Accuracy: the rounding of g0 T, 1e-5 rad after a second.
#pragma once

#include <cstddef>
#include <vector>

#include "signal/cube.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct Interferer {
  double start_frequency_Hz = 0.0;  // above 0
  double slope_Hz_per_s = 0.0;      // of either sign, or 0
  double duration_s = 0.0;          // of a chirp, above 0
  double interval_s = 0.0;          // from chirp to chirp, at least the duration; without end
  double start_s = 0.0;             // one of the chirps begins, on the waveform's clock
  double range_m = 0.0;             // at time 0 of the waveform, above 0
  double radial_speed_mps = 0.0;
  double azimuth_rad = 0.0, elevation_rad = 0.0;
  double power_W = 0.0;  // at one receiver's port while it is in the band
};

// P_i G_r lambda^2 / (4 pi R)^2: `eirp_W` the interferer's towards the receiver.
double interference_power_W(double eirp_W, double receive_gain, double wavelength_m,
                            double range_m);

// E-UNSUPPORTED for a waveform that add_interference does not take: to be asked before the work of synthesis.
void check_hears_others(const Waveform& waveform);

// Returns how many samples of the first channel got a beat at half of its amplitude or more.
std::size_t add_interference(const Waveform& waveform, int stage, const Array& array,
                             const std::vector<Interferer>& interferers, FloatCube& cube);

}  // namespace fanbeam::signal
