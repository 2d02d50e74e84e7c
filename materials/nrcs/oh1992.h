// Reflectivity of bare rough surfaces after Oh, Sarabandi and Ulaby.
//
//   vv = 0.7 (1 - exp(-0.65 ks^1.8)) cos^3(t) (|Gamma_V|^2 + |Gamma_H|^2) / sqrt(p)
//   hh = p vv,   hv = q vv
//   sqrt(p) = 1 - (2 t / pi)^(1 / (3 G0)) exp(-ks),   q = 0.23 sqrt(G0) (1 - exp(-ks))
//
// t is the incidence angle from the normal, ks the wave number times the rms height, G0 the normal
// power reflectivity. Source: Y. Oh, K. Sarabandi, F. T. Ulaby, IEEE Trans. Geosci. Remote Sens.
// 30(2), 370-381, 1992. Fitted to bare soil at 1.5 to 9.5 GHz, incidence 10 to 70 deg, 0.1 < ks <
// 6. Use at 35 GHz rests on equal ks; below 20 deg grazing it is extrapolation. Neglected:
// correlation length, volume scatter, the coherent echo at the normal. Accuracy: 1 to 2 dB on the
// soils it was made from; on pavement unknown, the rms height being the uncertain input.
#pragma once

#include "materials/dielectric/permittivity.h"

namespace fanbeam::materials {

struct OhNrcs {
  double hh = 0.0;
  double vv = 0.0;
  double hv = 0.0;
};

// All zero at grazing angles of zero and below. rms height 0 to 1 m, wavelength 1e-6 to 1e3 m,
// grazing at most pi/2, else InputError E-RANGE or E-NONFINITE.
OhNrcs oh1992_sigma0(const Permittivity& permittivity, double rms_height_m, double wavelength_m,
                     double grazing_rad);

}  // namespace fanbeam::materials
