// The phase that a scatterer's motion adds between the transmit slots of a time-division array.
//
// Transmitter in slot s sends s Ts after that in slot 0, so a Doppler frequency f turns its
// channels by 2 pi f s Ts (4 pi v Ts / lambda per slot: 3.65 deg per m/s at 76 GHz and 20 us). Left
// in, it looks like an angle: 7 deg off for 3 x 4 elements at 100 km/h. It is taken off
//   per cell       with the Doppler of the cell's centre: at most 180 deg / M (S - 1) / S is left
//                  (0.47 deg for 256 chirps, 3 slots)
//   per snapshot   with a refined Doppler: what is left is the error of that Doppler.
//
// Doppler is only known within +-1 / (2 S Ts): a fold k adds k / (S Ts) and turns slot s by another
// 2 pi k s / S. `doppler_fold` tries the S folds within +-1 / (2 Ts) and takes the one whose snapshot adds up to the
// strongest plane wave. Source: F. Roos et al., "Enhancement of Doppler unambiguity for
// chirp-sequence modulated TDM-MIMO radars", ICMIM 2018. It holds for one scatterer per cell. With
// 3 x 4 elements on a line the best wrong fold loses only 1.37 dB, so it needs a signal-to-noise
// ratio of some 10 dB per element.
//
// A simultaneous array has one slot: nothing is changed and the fold is 0.
#pragma once

#include <complex>
#include <vector>

#include "signal/angle/angle_peak.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {

// In place, on a cube whose chirps are all the Doppler cells of `range_doppler`.
template <typename Real>
void compensate_slots(Cube<Real>& range_doppler, const Array& array);

// `snapshot`: the channels of one cell, in place. E-RANGE if the sizes differ.
void compensate_slots(std::vector<std::complex<double>>& snapshot, const Array& array,
                      double doppler_Hz, double slot_period_s);

struct DopplerFold {
  int fold = 0;         // the true Doppler is doppler_Hz + fold / (slots Ts)
  AnglePeak direction;  // of the snapshot, compensated for that Doppler
};

DopplerFold doppler_fold(const std::vector<std::complex<double>>& snapshot, const Array& array,
                         double doppler_Hz, double slot_period_s, double wavelength_m);

}  // namespace fanbeam::signal
