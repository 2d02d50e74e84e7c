#include "renderer/plan/effect_catalogue.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "atmosphere/loss_table.h"
#include "atmosphere/path_attenuation.h"
#include "atmosphere/precipitation/rain_cells.h"
#include "core/constants.h"
#include "renderer/plan/effect_texts.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/plan/signal_effects.h"
#include "renderer/stages/fluctuation.h"
#include "renderer/stages/rain_echo.h"
#include "renderer/stages/range_response.h"
#include "renderer/stages/side_lobes.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/display/display.h"

namespace fanbeam::renderer {
namespace {

using atmosphere::Weather;

// At least so much is added to the heights: plans then do not hang on metres of lever.
constexpr double kLeastMargin_m = 300.0;
// The casters' table of losses begins this much below the ground.
constexpr double kTableMargin_m = 10.0;

// Sines of the lowest and highest elevation of the beam; all of them when it moves with the
// aircraft's attitude.
std::pair<double, double> sines_of_beam(const sensors::Sensor& sensor) {
  if (!sensor.scan.stabilised) return {-1.0, 1.0};
  const sensors::Antenna& antenna = sensor.antenna;
  const auto sine = [](double elevation_rad) {
    return std::sin(std::clamp(elevation_rad, -core::kPi / 2.0, core::kPi / 2.0));
  };
  const double reach_rad = sensors::reach_rad(antenna.elevation);
  return {sine(antenna.boresight_elevation_rad - reach_rad),
          sine(antenna.boresight_elevation_rad + reach_rad)};
}

// From the aircraft to its antenna, whatever its attitude.
double lever_m(const sensors::Mounting& mounting) {
  return std::hypot(mounting.forward_m, mounting.right_m, mounting.down_m);
}

double farthest_shown_m(const sensors::Sensor& sensor) {
  return sensor.range.maximum_m() + kSpreadCells * sensor.range.cell_m;
}

// The largest loss per kilometre at any height that is seen, all the way to the farthest range that
// shows in a cell.
double longest_path_dB(const SceneFacts& facts, core::EffectId effect) {
  Weather weather = facts.weather;
  weather.simulate_gas = effect == core::EffectId::gas;
  weather.simulate_fog = effect == core::EffectId::fog;
  weather.simulate_rain = effect == core::EffectId::rain;
  weather.simulate_snow = effect == core::EffectId::snow;
  const double frequency_Hz = facts.sensor.waveform.frequency_Hz;
  const double range_m = farthest_shown_m(facts.sensor);
  const atmosphere::PathAttenuation path(weather, frequency_Hz);
  const double lever = lever_m(facts.sensor.mounting);
  const double margin_m = height_margin_m(facts);
  double lowest_m = facts.lowest_m - kTableMargin_m;
  double highest_m = facts.highest_m + margin_m;
  // Over ground an antenna is above it, or sees nothing.
  if (facts.leaves_ground) lowest_m -= lever;
  // What falls echoes as high and, off the edge of the terrain, as low as the beam reaches.
  if (facts.largest_eta_m2_per_m3 > 0.0) {
    const auto [down, up] = sines_of_beam(facts.sensor);
    if (facts.leaves_ground) lowest_m -= margin_m + std::max(0.0, -range_m * down);
    highest_m += std::max(0.0, range_m * up);
  }
  const double layers_dB_per_km = path.largest_one_way_dB_per_km(lowest_m, highest_m);
  const atmosphere::RainCells cells(weather, frequency_Hz);
  // Out or back by way of a corner's mirror are two legs.
  const int legs = corners_possible(facts) ? 2 : 1;
  return 2.0 * (layers_dB_per_km * 1e-3 * range_m + cells.largest_one_way_dB(range_m, legs));
}

bool always(const SceneFacts&) { return true; }
bool has_fog(const SceneFacts& facts) { return atmosphere::has_fog(facts.weather); }
bool has_rain(const SceneFacts& facts) { return atmosphere::has_rain(facts.weather); }
bool has_snow(const SceneFacts& facts) { return atmosphere::has_snow(facts.weather); }

double gas_dB(const SceneFacts& facts) { return longest_path_dB(facts, core::EffectId::gas); }
double fog_dB(const SceneFacts& facts) { return longest_path_dB(facts, core::EffectId::fog); }
double rain_dB(const SceneFacts& facts) { return longest_path_dB(facts, core::EffectId::rain); }
double snow_dB(const SceneFacts& facts) { return longest_path_dB(facts, core::EffectId::snow); }

bool has_echo(const SceneFacts& facts) { return facts.largest_eta_m2_per_m3 > 0.0; }

// Noise in every cell, and in a row of the C-scope what the display adds there: of pictures, as it
// runs wherever watts are read (plan.cpp).
double noise_dB(const SceneFacts& with) {
  SceneFacts facts = with;
  facts.noise_shown = false;
  facts.read = {};
  const sensors::Sensor& sensor = facts.sensor;
  const AddedPower noise{
      std::vector<double>(static_cast<std::size_t>(sensor.range.cells), sensor.noise_power_W()),
      sensors::cscope_noise_W_m3(sensor)};
  return largest_change_dB(noise, facts);
}

double receiver_noise_dB(const SceneFacts& facts) { return facts.signal->window_dB; }

// At grazing angles every surface reflects all there is, and nothing limits how bright the corner
// is beside the display's floor; in a null of two rays a target is gone. No bound below the whole
// window holds for every scene.
bool has_surface_state(const SceneFacts& facts) { return facts.surface_not_dry; }
double whole_window_dB(const SceneFacts& facts) { return window_dB(facts.sensor); }

// The same holds for what another state makes of mirrors. What unchanged mirrors light scatters by
// sigma0 times a factor of its integral (surfaces/bistatic_nrcs.h): both change by as much.
double surface_state_dB(const SceneFacts& facts) {
  if (facts.state_changes_mirrors && has_mirrored_echo(facts)) return whole_window_dB(facts);
  return (corners_possible(facts) ? 2.0 : 1.0) * facts.surface_change_dB;
}

bool shows_sample(const SceneFacts& facts) { return facts.sample; }
bool targets_fluctuate(const SceneFacts& facts) {
  return facts.sample && facts.fluctuating_targets;
}

// Downwards from the mean to the smallest draw, whatever the looks; upwards 13.6 dB.
double fluctuation_dB(const SceneFacts&) { return kLargestFluctuation_dB; }

// Whether a model of atmosphere_models() is one of the effect.
bool causes(core::EffectId effect, std::string_view cause) {
  switch (effect) {
    case core::EffectId::gas:
      return cause == "gas";
    case core::EffectId::fog:
      return cause == "fog";
    case core::EffectId::rain:
      return cause == "rain" || cause == "melting";
    case core::EffectId::snow:
      return cause == "snow";
    case core::EffectId::rain_echo:
      return cause == "rain echo" || cause == "snow echo";
    default:
      return false;
  }
}

const std::vector<Effect>& sample_effects() {
  static const std::vector<Effect> kCatalogue = {
      {core::EffectId::receiver_noise, "noise of the receivers in the samples of every channel",
       "k T0 F fs, IEEE Std 686 noise figure", always, receiver_noise_dB, receiver_noise_cause, ""},
      {core::EffectId::phase_noise, "phase noise of the oscillator", "Budge and Burt 1993",
       has_phase_noise, phase_noise_bound_dB, phase_noise_cause,
       "no line width or table of phase noise was given (--line-width, --radar), or nothing "
       "echoes"},
      {core::EffectId::quantiser, "rounding of the samples", "Widrow and Kollar 2008",
       has_quantiser, quantiser_bound_dB, quantiser_cause,
       "no number of bits was given (--adc-bits)"},
      {core::EffectId::interference, "chirps of other radars in the receiver", "Brooker 2007",
       has_interference, interference_bound_dB, interference_cause,
       "no [[interferer]] of the scene is heard in this frame"},
  };
  return kCatalogue;
}

std::vector<Effect> effects_of_air() {
  return {
      {core::EffectId::gas,
       "two-way loss in oxygen and water vapour",
       "ITU-R P.676-13 Annex 1 on the P.835-6 standard atmosphere",
       always,
       gas_dB,
       gas_cause,
       "",
       {},
       true},
      {core::EffectId::fog,
       "two-way loss in fog droplets",
       "ITU-R P.840-8",
       has_fog,
       fog_dB,
       fog_cause,
       "the scene has no fog",
       {},
       true},
      {core::EffectId::rain,
       "two-way loss in rain, rain cells and the melting layer",
       "ITU-R P.838-3",
       has_rain,
       rain_dB,
       rain_cause,
       "the scene has no rain",
       {},
       true},
      {core::EffectId::snow,
       "two-way loss in dry snow",
       "Gunn and East 1954",
       has_snow,
       snow_dB,
       snow_cause,
       "the scene has no snow",
       {},
       true},
      {core::EffectId::rain_echo, "echo of rain and snow in the air",
       "Mie scattering over drop sizes, volume radar equation", has_echo, rain_echo_bound_dB,
       rain_echo_cause, "nothing falls in this scene", "neither rain nor snow falls within range"},
  };
}

std::vector<Effect> effects_of_surfaces() {
  return {
      {core::EffectId::double_bounce, "walls and ground seen through each other",
       "mirror and bistatic NRCS, docs/physics/double-bounce.md", corners_possible, whole_window_dB,
       double_bounce_cause,
       "the scene is level ground alone, or has nothing that is known to mirror at this frequency",
       "within range nothing mirrors, or nothing stands in the way of mirrored rays"},
      {core::EffectId::multipath, "point targets mirrored in the ground",
       "two-ray propagation factor, docs/physics/multipath.md", mirrored_targets_possible,
       whole_window_dB, multipath_cause,
       "the scene has no point targets, or no ground that is known to mirror at this frequency",
       "no point target is in view, or no ground mirrors within range", true},
      {core::EffectId::surface_state,
       "wet or snow-covered surfaces instead of dry ones",
       "rows of the material library, docs/physics/surface-state.md",
       has_surface_state,
       surface_state_dB,
       surface_state_cause,
       "the scene's surfaces are dry",
       {},
       true},
  };
}

std::vector<Effect> effects_of_radar() {
  return {
      {core::EffectId::side_lobes,
       "antenna gain outside the main beam",
       "uniform level, Skolnik, Introduction to Radar Systems, 3rd ed., chapter 9",
       has_side_lobes,
       side_lobe_bound_dB,
       side_lobe_cause,
       "the antenna has no side lobes (antenna.*.side_lobe_level_dB)",
       {},
       true},
      {core::EffectId::range_response, "spread of echoes along range by the sweep's window",
       "Harris 1978; docs/physics/range-response.md", has_range_response, range_response_bound_dB,
       range_response_cause, "range cells are ideal (waveform.window, scan.sweep)"},
      {core::EffectId::thermal_noise, "mean noise power of the receiver",
       "k T0 F / dwell, IEEE Std 686 noise figure", always, noise_dB, noise_cause, ""},
      {core::EffectId::speckle, "a realisation of ground and noise instead of their expected power",
       "gamma law of N looks, Goodman 1975", shows_sample, fluctuation_dB, speckle_cause,
       "frames show the expected power ([accuracy] realisation)"},
      {core::EffectId::swerling,
       "fluctuation of point targets",
       "Swerling 1954, cases 1 to 4",
       targets_fluctuate,
       fluctuation_dB,
       swerling_cause,
       "no target fluctuates, or frames show the expected power ([accuracy] realisation)",
       {},
       true},
  };
}

const std::vector<Effect>& picture_effects() {
  static const std::vector<Effect> kCatalogue = [] {
    std::vector<Effect> all;
    for (const auto& part : {effects_of_air(), effects_of_surfaces(), effects_of_radar()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kCatalogue;
}

}  // namespace

double height_margin_m(const SceneFacts& facts) {
  return std::max(kLeastMargin_m, lever_m(facts.sensor.mounting) +
                                      farthest_shown_m(facts.sensor) * facts.vertical_turn_rad);
}

const std::vector<Effect>& effect_catalogue(Touches touched) {
  return touched == Touches::samples ? sample_effects() : picture_effects();
}

std::string source_in(const Effect& effect, const atmosphere::Weather& weather) {
  std::vector<std::string> sources;
  for (const atmosphere::AtmosphereModel& model : atmosphere::atmosphere_models(weather))
    if (causes(effect.id, model.cause) &&
        std::find(sources.begin(), sources.end(), model.source) == sources.end())
      sources.push_back(model.source);
  std::string text;
  for (const std::string& source : sources) text += (text.empty() ? "" : "; ") + source;
  return text.empty() ? std::string(effect.source) : text;
}

std::vector<core::EffectId> effects_shown_in(Touches touched) {
  std::vector<core::EffectId> shown;
  for (const Effect& effect : picture_effects())
    if (touched == Touches::pictures || effect.in_echoes) shown.push_back(effect.id);
  if (touched == Touches::samples)
    for (const Effect& effect : sample_effects()) shown.push_back(effect.id);
  return shown;
}

}  // namespace fanbeam::renderer
