// Relative permittivity of liquid water at microwave and millimetre wavelengths.
//
// Double-Debye model of Recommendation ITU-R P.840-8, Annex 1, equations 4 to 10 (after Liebe,
// Hufford and Manabe 1991, stated there for frequencies below 1 THz); theta = 300 K / T.
// Inputs: 1e9 to 1e12 Hz, -40 to 50 C (water below 0 C is supercooled); not checked here.
// Neglected: salt, which matters below about 10 GHz only.
// Accuracy: the rows of P.840's loss are met to their ten printed digits (fog.h). Cost: 10 ns.
#pragma once

#include <complex>

namespace fanbeam::atmosphere {

// eps' + i eps'', the imaginary part positive for a lossy medium (time factor exp(-i w t)).
std::complex<double> water_permittivity(double frequency_Hz, double temperature_C);

}  // namespace fanbeam::atmosphere
