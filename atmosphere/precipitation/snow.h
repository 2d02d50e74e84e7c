// Dry snow: attenuation and radar reflectivity, from the rate of snowfall as melted water.
//
// Attenuation, one way: Gunn and East 1954 (Q. J. Royal Met. Soc. 80, 522),
//   gamma = 0.00349 R^1.6 / L^4 + 0.00224 R / L   [dB/km], R in mm/h of water, L in cm,
// scattering and absorption of small spheres at about 0 C. The first term is Rayleigh's and grows
// far too fast at short wavelengths: refused above 50 GHz.
// Accuracy: one published example value is met; nature: not better than a factor 2.
//
// Echo: Z = 1780 R^2.21 mm6/m3, Sekhon and Srivastava 1970 (J. Atmos. Sci. 27, 299), Z of the
// melted drops, so that eta = pi^5 0.208 Z / L^4 (Smith 1984, J. Clim. Appl. Met. 23, 1258: |K|^2
// of ice as if it had the density of water). Rayleigh: flakes larger than a wavelength return less,
// so at 35 GHz this is an upper bracket, up to 10 dB high in heavy snow. Refused above 40 GHz.
// Confidence: coefficients from secondary sources, the originals were not seen.
//
// Inputs: 1e9 Hz to the limits above, 0 to 50 mm/h. Neglected: shape and orientation of crystals,
// riming, temperature; wet snow is in melting_layer.h.
#pragma once

namespace fanbeam::atmosphere {

inline constexpr double kLargestSnowRate_mm_per_h = 50.0;

// Exactly 0 at 0 mm/h; the frequency is checked at every rate.
// Throws InputError: E-RANGE, E-NONFINITE.
double snow_attenuation_dB_per_km(double snow_rate_mm_per_h, double frequency_Hz);
double snow_eta_m2_per_m3(double snow_rate_mm_per_h, double frequency_Hz);

}  // namespace fanbeam::atmosphere
