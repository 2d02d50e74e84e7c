// Specific attenuation of clear air by oxygen and water vapour, 1 to 1000 GHz, one way.
//
// Source: Recommendation ITU-R P.676-13 (08/2022), Annex 1 (line by line), equations 1 to 9:
//   gamma = 0.1820 f (N_oxygen + N_dry + N_water)   [dB/km, f in GHz]
// with the sum over line strengths times Van Vleck-Weisskopf shapes and the dry continuum.
// The pressure is that of DRY air: total pressure minus the vapour's partial pressure. Taking the
// total for the dry pressure would be 1.2 % too much at 35 GHz.
// Neglected: Zeeman splitting (matters above about 40 km), trace gases.
// Accuracy: the ITU's own examples (120 points, 1 to 120 GHz) are met to 1e-12 relative.
// Cost: 79 lines per evaluation, 8 microseconds; meant for tables, not for inner loops.
#pragma once

#include "core/number_range.h"

namespace fanbeam::atmosphere {

inline constexpr core::NumberRange kGasPressures_hPa{0.0, 2000.0};  // of dry air
inline constexpr core::NumberRange kGasTemperatures_K{100.0, 350.0};

struct GasAttenuation {
  double oxygen_dB_per_km = 0.0;  // lines and dry continuum
  double water_dB_per_km = 0.0;

  double total_dB_per_km() const { return oxygen_dB_per_km + water_dB_per_km; }
};

// frequency 1e9 to 1e12 Hz, dry pressure and temperature as above, vapour density 0 to 300 g/m3. Throws InputError: E-RANGE, E-NONFINITE (all wrong inputs together).
GasAttenuation gas_attenuation(double frequency_Hz, double dry_pressure_hPa, double temperature_K,
                               double vapour_density_g_per_m3);

// e = rho T / 216.7 (P.676-13 equation 4).
double vapour_pressure_hPa(double vapour_density_g_per_m3, double temperature_K);

}  // namespace fanbeam::atmosphere
