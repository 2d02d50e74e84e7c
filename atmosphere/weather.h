// The weather of a scene as the attenuation models need it: plain data, horizontally uniform.
//
// The defaults are a standard day: no rain, no fog, the reference atmosphere of P.835-6. Heights
// are above the scene's origin (the airport reference point); only the air needs to know how high
// that origin lies. Fog and rain fill everything below their tops, valleys included.
#pragma once

#include <optional>

#include "atmosphere/fog/fog.h"
#include "atmosphere/fog/fog_water.h"
#include "atmosphere/precipitation/rain.h"
#include "core/errors.h"

namespace fanbeam::atmosphere {

struct Weather {
  // Fog is present when one of these two is set (not both) and means liquid water above zero.
  std::optional<double> visibility_m;           // 10 to 100000
  std::optional<double> liquid_water_g_per_m3;  // 0 to 20
  FogWaterModel fog_water_model = FogWaterModel::kunkel;
  FogLaw fog_law = FogLaw::itu_p840;
  double fog_top_m = 150.0;  // -2000 to 12000; radiation fog reaches tens to about 150 m

  double rain_rate_mm_per_h = 0.0;  // 0 to 300
  RainLaw rain_law = RainLaw::itu_p838;
  double rain_top_m = 3000.0;  // -2000 to 12000; about the melting height of temperate summers
  double polarisation_tilt_rad = 0.0;  // 0 horizontal, pi/2 vertical; -pi to pi

  // Air at the origin; what is unset follows the reference atmosphere at that height.
  double origin_height_m = 0.0;         // above mean sea level, -500 to 6000
  std::optional<double> temperature_C;  // -60 to 50; fog needs -40 or more
  std::optional<double> pressure_hPa;   // 300 to 1100, total
  std::optional<double> humidity;       // relative, 0 to 1; air inside fog is saturated anyway

  // Which losses are simulated. A switched-off loss is exactly 0 dB; the air stays as it is.
  bool simulate_gas = true;
  bool simulate_fog = true;
  bool simulate_rain = true;
};

// Liquid water of the fog, 0 without fog. Throws InputError: E-RANGE, E-NONFINITE.
double fog_liquid_water_g_per_m3(const Weather& weather);

// Temperature that the whole fog layer has: that of the air at the origin.
// Throws InputError: E-RANGE, E-NONFINITE.
double fog_temperature_C(const Weather& weather);

// One-way loss inside the fog and the rain layer, 0 without fog or rain, switched off or not. The
// rain is taken for horizontal paths: at 10 degrees elevation and 35 GHz that is 0.2 % too much
// for horizontal polarisation. Throws InputError: E-RANGE, E-NONFINITE.
double fog_layer_dB_per_km(const Weather& weather, double frequency_Hz);
double rain_layer_dB_per_km(const Weather& weather, double frequency_Hz);

// Everything wrong with the weather for a radar of this frequency (1e9 to 1e12 Hz), each with its
// class, field and allowed range; switched-off losses are checked too. Throws nothing.
core::ProblemList problems_in(const Weather& weather, double frequency_Hz);

}  // namespace fanbeam::atmosphere
