// Power over direction from a covariance, within the beamwidth, 0.886 wavelength / (N pitch).
//
//   capon    P = 1 / (a^H (R + d I)^-1 a)      d = loading tr R / N; power of a lone source in
//                                              white noise s2: p + s2 / N
//   music    P = 1 / |E_n^H a|^2               E_n: eigenvectors beside the `sources` largest;
//                                              a pseudo-power, whose peaks only tell directions
//
// Sources: J. Capon, Proc. IEEE 57, 1969; R. O. Schmidt, IEEE Trans. AP-34, 1986.
// `spectrum_peaks` gives maxima over the beams, refined by a parabola in decibels, strongest first.
//
// Reference rates (12 elements at half a wavelength, 64 snapshots, two equal uncorrelated sources
// 3.5 deg apart, 10 dB): beams never, Capon half of the time, MUSIC always separates them.
//
// Inputs: steering of the covariance's size; loading 0 or more (0 needs as many snapshots as
// elements); sources 0 to N - 1. E-RANGE otherwise. A covariance that cannot be inverted (all zero,
// say) gives zeros. Accuracy: 1e-10 relative for condition numbers to 1e6.
#pragma once

#include <vector>

#include "signal/angle/covariance.h"
#include "signal/angle/steering.h"

namespace fanbeam::signal {

// One value per beam.
std::vector<double> capon_spectrum(const Covariance& covariance, const Steering& steering,
                                   double loading = 0.0);
std::vector<double> music_spectrum(const Covariance& covariance, const Steering& steering,
                                   int sources);

// Rising.
std::vector<double> eigenvalues(const Covariance& covariance);

struct SpectrumPeak {
  double beam = 0.0;  // fractional index
  double power = 0.0;
};
std::vector<SpectrumPeak> spectrum_peaks(const std::vector<double>& powers);

}  // namespace fanbeam::signal
