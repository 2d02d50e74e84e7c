// Relative permittivity of dry and of wet snow.
//
//   dry   eps' = 1 + 1.7 r + 0.7 r^2, no loss
//   wet   eps' = A + B m^1.31 / (1 + (f/f0)^2),  eps'' = C (f/f0) m^1.31 / (1 + (f/f0)^2)
//         A  = A1 (1 + 1.83 r + 0.02 m^1.015) + B1,  B = 0.073 A1,  C = 0.073 A2,  f0 = 9.07 GHz
//         A1 = 0.78 + 0.03 f - 0.58e-3 f^2,  A2 = 0.97 - 0.39e-2 f + 0.39e-3 f^2,
//         B1 = 0.31 - 0.05 f + 0.87e-3 f^2
//
// r is the density of the ice skeleton (dry snow) in g/cm3, m the liquid water in percent of the
// volume, f in GHz. Dry: Kendra, Sarabandi and Ulaby, IEEE Trans. Geosci. Remote Sens. 36 (1998).
// Wet: the modified Debye-like model of Hallikainen, Ulaby and Abdelrazik, IEEE Trans. Antennas
// Propag. 34(11), 1329-1340 (1986), in the form of Ulaby and Long, Microwave Radar and Radiometric
// Remote Sensing (2014), section 4-6.2, where A1 multiplies the whole bracket: the 1986 print's A
// does not reproduce its own figures. The coefficients were compared with three public
// transcriptions, the results with values read off the book's figures 4-22 and 4-23.
//
// Inputs outside the stated ranges throw InputError E-RANGE or E-NONFINITE. Neglected: grain size
// and shape, temperature (wet snow melts, 0 C), impurities, and scatter, which at 35 GHz is as
// important as absorption in coarse snow. Accuracy: the fit's authors give 0.1 in eps' and 0.05 in
// eps''. The wet model does not tend to the dry one for m -> 0: at 35 GHz and 240 kg/m3 its limit
// is 1.24 against 1.45. Cost: two powers.
#pragma once

#include "materials/dielectric/permittivity.h"
#include "materials/interval.h"

namespace fanbeam::materials {

// Where the density alone decides; the formula itself holds from 1 MHz up.
inline constexpr Interval kDrySnowFrequencies_Hz{1e6, 100e9};
inline constexpr Interval kWetSnowFrequencies_Hz{3e9, 37e9};

// Density 0 to 500 kg/m3.
Permittivity dry_snow_permittivity(double density_kg_per_m3);

struct WetSnow {
  double dry_density_kg_per_m3 = 240.0;  // 90 to 380
  double liquid_volume_fraction = 0.05;  // 0.01 to 0.12
};

Permittivity wet_snow_permittivity(const WetSnow& snow, double frequency_Hz);

}  // namespace fanbeam::materials
