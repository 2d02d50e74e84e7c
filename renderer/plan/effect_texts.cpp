#include "renderer/plan/effect_texts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "atmosphere/fog/fog_water.h"
#include "renderer/plan/largest_echo.h"
#include "sensors/receiver/point_response.h"

namespace fanbeam::renderer {
namespace {

// As printf does with %.<precision>f or g in the locale "C", under any locale.
std::string printed(double value, std::chars_format format, int precision) {
  std::array<char, 400> text;  // holds the largest double
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), value, format, precision);
  return {text.data(), result.ptr};
}

std::string with_decimals(double value, int decimals) {
  return printed(value, std::chars_format::fixed, decimals);
}

std::string with_digits(double value, int digits) {
  return printed(value, std::chars_format::general, digits);
}

std::string range_text(const SceneFacts& facts) {
  const double range_m = facts.sensor.range.maximum_m();
  return range_m < 1000.0 ? with_decimals(range_m, 0) + " m"
                          : with_decimals(range_m / 1000.0, 1) + " km";
}

std::string dB_text(double value_dB) { return figure_text(value_dB) + " dB"; }

std::string window_text(const SceneFacts& facts) {
  return "the display's whole window of " + dB_text(window_dB(facts.sensor));
}

// `what` is plural or not: "take" or "takes".
std::string loss_text(const std::string& what, const std::string& takes, const SceneFacts& facts,
                      double bound_dB) {
  if (bound_dB == 0.0) return what + " lies outside the heights that are seen";
  return what + " " + takes + " up to " + dB_text(bound_dB) + " both ways over " +
         range_text(facts);
}

std::string lift_text(const std::string& what, const SceneFacts& facts, double bound_dB) {
  const std::string lifts =
      what + " can lift " + (facts.read.watts() ? "the watts of a dark cell" : "a black pixel");
  if (bound_dB >= window_dB(facts.sensor)) return lifts + " through " + window_text(facts);
  return lifts + " by up to " + dB_text(bound_dB);
}

double heaviest_rain_mm_per_h(const atmosphere::Weather& weather) {
  double most = weather.rain_rate_mm_per_h;
  for (const atmosphere::RainCell& cell : weather.rain_cells)
    most = std::max(most, cell.rain_rate_mm_per_h);
  return most;
}

std::string rain_text(const atmosphere::Weather& weather) {
  return "rain of " + figure_text(heaviest_rain_mm_per_h(weather)) + " mm/h";
}

std::string snow_text(const atmosphere::Weather& weather) {
  return "snow of " + figure_text(weather.snow_rate_mm_per_h) + " mm/h";
}

}  // namespace

std::string figure_text(double value) {
  if (value > 0.0 && value < 0.001) return "under 0.001";
  if (value >= 9.95) return with_decimals(value, 0);
  if (value >= 0.995) return with_decimals(value, 1);
  return with_digits(value, 2);
}

std::string gas_cause(const SceneFacts& facts, double bound_dB) {
  return loss_text("oxygen and water vapour", "take", facts, bound_dB);
}

std::string fog_cause(const SceneFacts& facts, double bound_dB) {
  double most_g_per_m3 = 0.0;
  std::string what = "fog";
  for (const atmosphere::FogLayer& layer : atmosphere::fog_in(facts.weather)) {
    const double water_g_per_m3 = layer.visibility_m ? atmosphere::liquid_water_g_per_m3(
                                                           layer.water_model, *layer.visibility_m)
                                                     : layer.liquid_water_g_per_m3.value_or(0.0);
    if (!(water_g_per_m3 > most_g_per_m3)) continue;
    most_g_per_m3 = water_g_per_m3;
    what = "fog of " + figure_text(water_g_per_m3) + " g/m3";
    if (layer.visibility_m) what += ", visibility " + figure_text(*layer.visibility_m) + " m,";
  }
  return loss_text(what, "takes", facts, bound_dB);
}

std::string rain_cause(const SceneFacts& facts, double bound_dB) {
  return loss_text(rain_text(facts.weather), "takes", facts, bound_dB);
}

std::string snow_cause(const SceneFacts& facts, double bound_dB) {
  return loss_text(snow_text(facts.weather), "takes", facts, bound_dB);
}

std::string rain_echo_cause(const SceneFacts& facts, double bound_dB) {
  const bool rain = atmosphere::has_rain(facts.weather);
  const bool snow = atmosphere::has_snow(facts.weather);
  std::string what = rain ? rain_text(facts.weather) : "";
  if (snow) what += (rain ? " and " : "") + snow_text(facts.weather);
  return lift_text("the echo of " + what, facts, bound_dB);
}

std::string double_bounce_cause(const SceneFacts& facts, double) {
  return "what mirrored rays meet, a wall or rising ground, can be as bright as a corner "
         "reflector, up to " +
         window_text(facts);
}

std::string multipath_cause(const SceneFacts& facts, double) {
  return "a point target over mirroring ground can vanish or shine, up to " + window_text(facts);
}

std::string surface_state_cause(const SceneFacts& facts, double bound_dB) {
  if (facts.state_changes_mirrors && has_mirrored_echo(facts))
    return "wet or snow-covered surfaces mirror otherwise than dry ones, which can change " +
           window_text(facts);
  return std::string("wet or snow-covered surfaces") +
         (corners_possible(facts) ? " and their corners" : "") + " differ from dry ones by up to " +
         dB_text(bound_dB);
}

std::string side_lobe_cause(const SceneFacts& facts, double bound_dB) {
  return lift_text("what the antenna sees beside its main beam", facts, bound_dB);
}

std::string range_response_cause(const SceneFacts& facts, double bound_dB) {
  const sensors::PointResponse ahead(facts.sensor, facts.sensor.scan.columns / 2);
  const std::string width = with_digits(ahead.half_power_width_m(), 3) + " m (half power)";
  if (bound_dB >= window_dB(facts.sensor))
    return "the sweep spreads an echo over " + width + " of range, a bright one through " +
           window_text(facts);
  return "the sweep spreads echoes over " + width + " of range and changes pixels by up to " +
         dB_text(bound_dB);
}

std::string noise_cause(const SceneFacts& with, double bound_dB) {
  SceneFacts facts = with;
  facts.read = {};  // its bound is of pictures
  const double noise_dBm = 10.0 * std::log10(facts.sensor.noise_power_W()) + 30.0;
  return lift_text("the receiver's noise of " + with_decimals(noise_dBm, 0) + " dBm", facts,
                   bound_dB);
}

std::string speckle_cause(const SceneFacts&, double bound_dB) {
  return "speckle and drawn noise stray from the expected power by up to " + dB_text(bound_dB);
}

std::string swerling_cause(const SceneFacts&, double bound_dB) {
  return "fluctuating targets stray from their mean by up to " + dB_text(bound_dB);
}

}  // namespace fanbeam::renderer
