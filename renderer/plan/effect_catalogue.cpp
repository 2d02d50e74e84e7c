#include "renderer/plan/effect_catalogue.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/precipitation/rain_cells.h"
#include "renderer/plan/display_floor.h"
#include "renderer/stages/fluctuation.h"
#include "renderer/stages/rain_echo.h"
#include "renderer/stages/range_response.h"
#include "renderer/stages/side_lobes.h"

namespace fanbeam::renderer {
namespace {

using atmosphere::Weather;

// Buildings and models rise above the ground by up to this.
constexpr double kTallest_m = 300.0;

// The largest loss per kilometre at any height of the scene, all the way to the farthest range.
double longest_path_dB(const SceneFacts& facts, std::string_view effect) {
  Weather weather = facts.weather;
  weather.simulate_gas = effect == kGas;
  weather.simulate_fog = effect == kFog;
  weather.simulate_rain = effect == kRain;
  weather.simulate_snow = effect == kSnow;
  const double frequency_Hz = facts.sensor.waveform.frequency_Hz;
  const double range_m = facts.sensor.range.maximum_m();
  const atmosphere::PathAttenuation path(weather, frequency_Hz);
  const double layers_dB_per_km =
      path.largest_one_way_dB_per_km(facts.lowest_m, facts.highest_m + kTallest_m);
  const atmosphere::RainCells cells(weather, frequency_Hz);
  return 2.0 * (layers_dB_per_km * 1e-3 * range_m + cells.largest_one_way_dB(range_m));
}

bool always(const SceneFacts&) { return true; }
bool has_fog(const SceneFacts& facts) { return atmosphere::has_fog(facts.weather); }
bool has_rain(const SceneFacts& facts) { return atmosphere::has_rain(facts.weather); }
bool has_snow(const SceneFacts& facts) { return atmosphere::has_snow(facts.weather); }

double gas_dB(const SceneFacts& facts) { return longest_path_dB(facts, kGas); }
double fog_dB(const SceneFacts& facts) { return longest_path_dB(facts, kFog); }
double rain_dB(const SceneFacts& facts) { return longest_path_dB(facts, kRain); }
double snow_dB(const SceneFacts& facts) { return longest_path_dB(facts, kSnow); }

bool has_echo(const SceneFacts& facts) { return facts.largest_eta_m2_per_m3 > 0.0; }

// Noise against the display floor in the farthest cell, where compensation lifts it most.
double noise_dB(const SceneFacts& facts) {
  const double floor_W = display_floor_W(facts.sensor, facts.sensor.range.maximum_m());
  return 10.0 * std::log10(1.0 + facts.sensor.noise_power_W() / floor_W);
}

// At grazing angles every surface reflects all there is, and nothing limits how bright the corner
// is beside the display's floor; in a null of two rays a target is gone. No bound below the whole
// window holds for every scene.
bool has_corners(const SceneFacts& facts) { return facts.has_walls && facts.reflects; }
bool has_mirrored_targets(const SceneFacts& facts) {
  return facts.has_point_targets && facts.ground_reflects;
}
bool has_surface_state(const SceneFacts& facts) { return facts.surface_not_dry; }
double surface_state_dB(const SceneFacts& facts) { return facts.surface_change_dB; }
double whole_window_dB(const SceneFacts& facts) {
  return facts.sensor.display.high_dB - facts.sensor.display.low_dB;
}

bool shows_sample(const SceneFacts& facts) { return facts.sample; }
bool targets_fluctuate(const SceneFacts& facts) {
  return facts.sample && facts.fluctuating_targets;
}

// Downwards from the mean to the smallest draw, whatever the looks; upwards 13.6 dB.
double fluctuation_dB(const SceneFacts&) { return kLargestFluctuation_dB; }

}  // namespace

const std::vector<Effect>& effect_catalogue() {
  static const std::vector<Effect> kCatalogue = {
      {kGas, "two-way loss in oxygen and water vapour",
       "ITU-R P.676-13 Annex 1 on the P.835-6 standard atmosphere", always, gas_dB, ""},
      {kFog, "two-way loss in fog droplets", "ITU-R P.840-8", has_fog, fog_dB,
       "the scene has no fog"},
      {kRain, "two-way loss in rain, rain cells and the melting layer", "ITU-R P.838-3", has_rain,
       rain_dB, "the scene has no rain"},
      {kSnow, "two-way loss in dry snow", "Gunn and East 1954", has_snow, snow_dB,
       "the scene has no snow"},
      {kRainEcho, "echo of rain and snow in the air",
       "Mie scattering over drop sizes, volume radar equation", has_echo, rain_echo_bound_dB,
       "nothing falls in this scene"},
      {kDoubleBounce, "wall and ground, or two walls, seen through each other",
       "mirror and bistatic NRCS, docs/physics/double-bounce.md", has_corners, whole_window_dB,
       "the scene has no walls, or nothing in it reflects like a mirror"},
      {kMultipath, "point targets mirrored in the ground",
       "two-ray propagation factor, docs/physics/multipath.md", has_mirrored_targets,
       whole_window_dB, "the scene has no point targets, or no ground that reflects like a mirror"},
      {kSurfaceState, "wet or snow-covered surfaces instead of dry ones",
       "rows of the material library, docs/physics/surface-state.md", has_surface_state,
       surface_state_dB, "the scene's surfaces are dry"},
      {kSideLobes, "antenna gain outside the main beam",
       "uniform level, Skolnik, Introduction to Radar Systems, 3rd ed., chapter 9", has_side_lobes,
       side_lobe_bound_dB, "the antenna has no side lobes (antenna.*.side_lobe_level_dB)"},
      {kRangeResponse, "spread of echoes along range by the sweep's window",
       "Harris 1978; docs/physics/range-response.md", has_range_response, range_response_bound_dB,
       "range cells are ideal (waveform.window, scan.sweep)"},
      {kThermalNoise, "mean noise power of the receiver",
       "k T0 F / dwell, IEEE Std 686 noise figure", always, noise_dB, ""},
      {kSpeckle, "a realisation of ground and noise instead of their expected power",
       "gamma law of N looks, Goodman 1975", shows_sample, fluctuation_dB,
       "frames show the expected power ([accuracy] realisation)"},
      {kSwerling, "fluctuation of point targets", "Swerling 1954, cases 1 to 4",
       targets_fluctuate, fluctuation_dB,
       "no target fluctuates, or frames show the expected power ([accuracy] realisation)"},
  };
  return kCatalogue;
}

}  // namespace fanbeam::renderer
