// The weather of a scene as the attenuation and echo models need it: plain data. Everything is the
// same along the ground, but for the rain cells.
//
// The defaults are a standard day: no rain, no fog, no snow, the reference atmosphere of P.835-6.
// Heights are above the scene's origin (the airport reference point); only the air needs to know
// how high that origin lies. Fog, rain and snow without a base fill everything below their tops,
// valleys included.
#pragma once

#include <optional>
#include <vector>

#include "atmosphere/fog/fog_layer.h"
#include "atmosphere/gas/sounding.h"
#include "atmosphere/precipitation/melting_layer.h"
#include "atmosphere/precipitation/rain.h"
#include "atmosphere/precipitation/rain_cell.h"
#include "atmosphere/precipitation/rain_echo.h"
#include "atmosphere/precipitation/snow.h"
#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {

// Between these the profiles are computed; beyond them their values go on.
inline constexpr double kLowestWeather_m = -2000.0;
inline constexpr double kHighestWeather_m = 12000.0;
// Of the models together; some laws take less.
inline constexpr core::NumberRange kWeatherFrequencies_Hz{1e9, 1e12};

enum class GasPart { whole, oxygen, vapour };

struct Weather {
  // Fog is present when one of these two is set (not both) and means liquid water above zero.
  std::optional<double> visibility_m;           // 10 to 100000
  std::optional<double> liquid_water_g_per_m3;  // 0 to 20
  FogWaterModel fog_water_model = FogWaterModel::kunkel;
  FogLaw fog_law = FogLaw::itu_p840;
  double fog_top_m = 150.0;  // -2000 to 12000; radiation fog reaches tens to about 150 m
  // More fog or cloud; where layers overlap, their losses add.
  std::vector<FogLayer> fog_layers;

  double rain_rate_mm_per_h = 0.0;  // 0 to 300
  RainLaw rain_law = RainLaw::itu_p838;
  RainEchoLaw rain_echo_law = RainEchoLaw::mie;
  DropSizes drop_sizes = DropSizes::marshall_palmer;
  double rain_top_m = 3000.0;  // -2000 to 12000; about the melting height of temperate summers
  double polarisation_tilt_rad = 0.0;    // 0 horizontal, pi/2 vertical; -pi to pi
  double rain_path_elevation_rad = 0.0;  // for the rain law alone; -pi/2 to pi/2
  std::vector<RainCell> rain_cells;      // on top of that rain

  // With a melting layer the rain ends at the rain height (melting_layer.h), not at rain_top_m.
  bool melting_layer = false;              // at the height where the air passes 0 C, or
  std::optional<double> melting_height_m;  // at this 0 C level, -2000 to 11640

  // Dry snow, water equivalent: above the rain height when there is a melting layer, else down to
  // the ground, and then without rain beside it.
  double snow_rate_mm_per_h = 0.0;  // 0 to 50
  double snow_top_m = 6000.0;       // -2000 to 12000

  // Air at the origin; what is unset follows the reference atmosphere at that height.
  double origin_height_m = 0.0;         // above mean sea level, -500 to 6000
  std::optional<double> temperature_C;  // -60 to 50; fog needs -40 or more
  std::optional<double> pressure_hPa;   // 300 to 1100, total
  std::optional<double> humidity;       // relative, 0 to 1; air inside fog is saturated anyway
  // Air at several heights instead (sounding.h); temperature_C and humidity are then unset.
  std::vector<AirLevel> levels;

  // Which losses are simulated. A switched-off loss is exactly 0 dB; the air stays as it is. Rain
  // means rain, melting layer and rain cells. For look-ups: a scene has a plan for it and refuses a
  // false one.
  bool simulate_gas = true;
  GasPart gas_part = GasPart::whole;  // what of the gas counts: one alone for look-ups
  bool simulate_fog = true;
  bool simulate_rain = true;
  bool simulate_snow = true;
};

// Liquid water of the fog below fog_top_m, 0 without fog. Throws InputError: E-RANGE, E-NONFINITE.
double fog_liquid_water_g_per_m3(const Weather& weather);

// All fog: what lies below fog_top_m, if anything, then the layers, those without water left out.
// Throws InputError: E-RANGE, E-NONFINITE.
std::vector<FogLayer> fog_in(const Weather& weather);

// Some fog, rain or snow is there (switched off or not).
bool has_fog(const Weather& weather);
bool has_rain(const Weather& weather);
bool has_snow(const Weather& weather);

// Temperature that a whole fog layer has: that of the air in its middle when its base is above the
// origin, else that at the origin. Throws InputError: E-RANGE, E-NONFINITE.
double fog_temperature_C(const Weather& weather, const FogLayer& layer);

// Temperature of raindrops: that of the air at the origin, but 0 to 40 C.
double rain_temperature_C(const Weather& weather);

// The drops of the rain, for laws that want to know.
RainDrops rain_drops(const Weather& weather);

// One-way loss inside a fog layer, and in rain of a rate below the melting layer; switched off or
// not. The rain is taken for paths of one elevation, in scenes horizontal: at 10 degrees elevation
// and 35 GHz that is 0.2 % too much for horizontal polarisation. Throws InputError: E-RANGE,
// E-NONFINITE.
double fog_layer_dB_per_km(const Weather& weather, const FogLayer& layer, double frequency_Hz);
double rain_dB_per_km(const Weather& weather, double rain_rate_mm_per_h, double frequency_Hz);

// Where the uniform rain, the melting layer and the snow are. The weather must be valid.
PrecipitationLayers precipitation_layers(const Weather& weather);

// Everything wrong with the weather for a radar of this frequency (1e9 to 1e12 Hz), each with its
// class, field and allowed range; switched-off losses are checked too. Throws nothing.
core::ProblemList problems_in(const Weather& weather, double frequency_Hz);

}  // namespace fanbeam::atmosphere
