// Radar reflectivity of rain: cross-section per volume, eta in m2/m3.
//
// mie (default): water spheres of a drop-size law, drop_scattering.h. 1 to 1000 GHz, meant for 10
// to 100 GHz. Rayleigh's Z = 200 R^1.6 is no use here: at 35 GHz it is 0.57, 1.2 and 3.3 times the
// Mie value at 1, 10 and 50 mm/h, at 94 GHz up to 190 times.
//
// mie-fit: log10 eta = q0 + q1 x + q2 x^2, x = log10 R, a least-squares fit to mie with
// Marshall-Palmer drops at 10 C from 0.5 to 100 mm/h; largest error 0.24 dB at 9.4 GHz, 0.14 at 24,
// 0.04 at 35, 0.11 at 76.5 and 94. Accepted within 2 % of these frequencies and at those rates.
//
// georgia-tech-1975: measured power laws, 1.3e-8 R^1.6 at 9.4 GHz, 1.2e-6 R^1.6 at 35, 4.2e-5 R^1.1
// at 70, 1.5e-5 R^1.0 at 95; accepted within 2 % of these. At 10 mm/h 6 to 8.5 dB below Mie at 9.4,
// 35 and 95 GHz: a low bracket. Confidence: coefficients quoted from the literature without sight
// of the original.
//
// All: linear polarisation, co-polar. Circular polarisation would return 15 to 25 dB less, which is
// not modelled.
#pragma once

#include <string_view>

#include "atmosphere/precipitation/rain.h"

namespace fanbeam::atmosphere {

enum class RainEchoLaw { mie, mie_fit, georgia_tech_1975 };

// "mie", "mie-fit", "georgia-tech-1975". Throws InputError E-REF for any other name.
RainEchoLaw rain_echo_law_named(std::string_view name);
std::string_view name_of(RainEchoLaw law);

// Rain rate 0 to 300 mm/h; exactly 0 at 0 mm/h. The law's frequencies are checked at every rate.
// Throws InputError: E-RANGE, E-NONFINITE.
double rain_eta_m2_per_m3(RainEchoLaw law, double rain_rate_mm_per_h, double frequency_Hz,
                          const RainDrops& drops = {});

}  // namespace fanbeam::atmosphere
