// Specific attenuation of rain, one way.
//
// itu-p838 (default): Recommendation ITU-R P.838-3 (03/2005), gamma = k R^alpha with R in mm/h; k
// and alpha from the regressions of Tables 1 to 4, combined for path elevation and polarisation by
// equations 4 and 5. 1 to 1000 GHz. It is a fit to a median climate: with the drop sizes of
// drizzle or thunderstorms the loss at 35 GHz and 10 mm/h lies between 2.0 and 2.8 dB/km (2.7
// here). The path reduction factors of link planning do not belong to a simulated rain field and
// are left out.
// Accuracy against the ITU's examples: 2e-7 relative (their printed digits).
//
// georgia-tech-95: 1.6 R^0.64, the 95 GHz member of the Georgia Tech 1975 set, accepted from 90 to
// 100 GHz only, whatever the polarisation; within 22 % of P.838-3 at 94 GHz from 1 to 100 mm/h. At
// 35 GHz the formula would give more than twice the loss of P.838-3 up to 10 mm/h.
#pragma once

#include <string_view>

namespace fanbeam::atmosphere {

enum class RainLaw { itu_p838, georgia_tech_95 };

// "itu-p838", "georgia-tech-95". Throws InputError E-REF for any other name.
RainLaw rain_law_named(std::string_view name);
std::string_view name_of(RainLaw law);

inline constexpr double kLargestRainRate_mm_per_h = 300.0;

// gamma = k R^alpha in dB/km for R in mm/h.
struct RainCoefficients {
  double k = 0.0;
  double alpha = 0.0;
};

// P.838-3. frequency 1e9 to 1e12 Hz, path elevation -pi/2 to pi/2, polarisation tilt -pi to pi
// (0 horizontal, pi/2 vertical, pi/4 also stands for circular).
// Throws InputError: E-RANGE, E-NONFINITE.
RainCoefficients rain_coefficients(double frequency_Hz, double path_elevation_rad,
                                   double polarisation_tilt_rad);

// Rain rate 0 to 300 mm/h; exactly 0 dB/km at 0 mm/h. The law's own frequency range is checked at
// every rate. Throws InputError: E-RANGE, E-NONFINITE.
double rain_attenuation_dB_per_km(RainLaw law, double rain_rate_mm_per_h, double frequency_Hz,
                                  double path_elevation_rad, double polarisation_tilt_rad);

}  // namespace fanbeam::atmosphere
