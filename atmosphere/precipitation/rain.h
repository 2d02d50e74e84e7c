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
//
// mie: water spheres of a drop-size law, drop_scattering.h, whatever the polarisation. The only law
// that knows temperature and drop sizes; consistent with the echo of rain_echo.h. Marshall-Palmer
// at 10 C and 35 GHz gives 5 % less loss than P.838-3 (H) at 4 mm/h and 11 % more at 50 mm/h.
#pragma once

#include <string_view>

#include "atmosphere/precipitation/drop_sizes.h"

namespace fanbeam::atmosphere {

enum class RainLaw { itu_p838, georgia_tech_95, mie };

// "itu-p838", "georgia-tech-95", "mie". Throws InputError E-REF for any other name.
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

// The drops of a rain; only the law mie asks for them.
struct RainDrops {
  DropSizes sizes = DropSizes::marshall_palmer;
  double temperature_C = 10.0;  // 0 to 40
};

// Rain rate 0 to 300 mm/h; exactly 0 dB/km at 0 mm/h. The law's own frequency range is checked at
// every rate. Throws InputError: E-RANGE, E-NONFINITE.
double rain_attenuation_dB_per_km(RainLaw law, double rain_rate_mm_per_h, double frequency_Hz,
                                  double path_elevation_rad, double polarisation_tilt_rad,
                                  const RainDrops& drops = {});

}  // namespace fanbeam::atmosphere
