#include "renderer/plan/effect_catalogue.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/path_attenuation.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

using atmosphere::Weather;

// A path at one height bounds every path of the same length once the height with the largest
// attenuation is taken. The layers' attenuation falls with height inside a layer, so the lowest
// height and the layer tops are enough.
double longest_level_path_dB(const SceneFacts& facts, bool gas, bool fog, bool rain) {
  Weather weather = facts.weather;
  weather.simulate_gas = gas;
  weather.simulate_fog = fog;
  weather.simulate_rain = rain;
  const atmosphere::PathAttenuation path(weather, facts.sensor.waveform.frequency_Hz);
  double most_dB = 0.0;
  for (const double height_m : {facts.lowest_m, weather.fog_top_m, weather.rain_top_m})
    most_dB =
        std::max(most_dB, path.one_way_dB(height_m, height_m, facts.sensor.range.maximum_m()));
  return 2.0 * most_dB;
}

bool always(const SceneFacts&) { return true; }
bool has_fog(const SceneFacts& facts) {
  return atmosphere::fog_liquid_water_g_per_m3(facts.weather) > 0.0;
}
bool has_rain(const SceneFacts& facts) { return facts.weather.rain_rate_mm_per_h > 0.0; }

double gas_dB(const SceneFacts& facts) { return longest_level_path_dB(facts, true, false, false); }
double fog_dB(const SceneFacts& facts) { return longest_level_path_dB(facts, false, true, false); }
double rain_dB(const SceneFacts& facts) { return longest_level_path_dB(facts, false, false, true); }

// Noise against the display floor in the farthest cell, where compensation lifts it most.
double noise_dB(const SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  const double range_m = sensor.range.maximum_m();
  const double ground_W = sensor.radar_constant_W_m2() *
                          sensors::two_way_width(sensor.antenna.azimuth) * sensor.range.cell_m /
                          (range_m * range_m * range_m);
  const double floor_W = sensor.display.mapping == sensors::Display::Mapping::stc
                             ? ground_W * std::pow(10.0, sensor.display.low_dB / 10.0)
                             : std::pow(10.0, sensor.display.low_dB / 10.0);
  return 10.0 * std::log10(1.0 + sensor.noise_power_W() / floor_W);
}

}  // namespace

const std::vector<Effect>& effect_catalogue() {
  static const std::vector<Effect> kCatalogue = {
      {kGas, "two-way loss in oxygen and water vapour",
       "ITU-R P.676-13 Annex 1 on the P.835-6 standard atmosphere", always, gas_dB, ""},
      {kFog, "two-way loss in fog droplets", "ITU-R P.840-8", has_fog, fog_dB,
       "the scene has no fog"},
      {kRain, "two-way loss in rain", "ITU-R P.838-3", has_rain, rain_dB, "the scene has no rain"},
      {kThermalNoise, "mean noise power of the receiver",
       "k T0 F / dwell, IEEE Std 686 noise figure", always, noise_dB, ""},
  };
  return kCatalogue;
}

}  // namespace fanbeam::renderer
