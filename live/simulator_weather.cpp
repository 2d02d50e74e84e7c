#include "live/simulator_weather.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "live/answers_private.h"

namespace fanbeam::live {
namespace {

// To two digits.
double rounded(double value) {
  if (!(value > 0.0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::round(value / unit);
}

// `now` where nothing is told.
double rate_mm_per_h(const std::optional<double>& norm, double heaviest, double power, double now) {
  constexpr double kLeast_mm_per_h = 0.1;
  if (!norm) return now;
  const double rate = rounded(heaviest * std::pow(std::clamp(*norm, 0.0, 1.0), power));
  return rate < kLeast_mm_per_h ? 0.0 : rate;
}

}  // namespace

std::string weather_body(const feeds::AircraftState& state, const atmosphere::Weather& now) {
  constexpr double kFog_m = 1000.0, kThickest_m = 10.0;
  Json body = weather_json(now);
  const double rain = rate_mm_per_h(state.rain_norm, 22.0, 2.7, now.rain_rate_mm_per_h);
  const double snow = rate_mm_per_h(state.snow_norm, 7.0, 2.2, now.snow_rate_mm_per_h);
  const bool rain_told = state.rain_norm.has_value(), snow_told = state.snow_norm.has_value();
  const bool rain_counts = rain_told == snow_told ? rain >= snow : rain_told;
  const bool both =
      rain > 0.0 && snow > 0.0 && (rain_told || snow_told) && !body["melting_layer"].get<bool>();
  body["rain_rate_mm_per_h"] = both && !rain_counts ? 0.0 : rain;
  body["snow_rate_mm_per_h"] = both && rain_counts ? 0.0 : snow;
  if (state.visibility_m || body["visibility_m"].is_null()) body.erase("visibility_m");
  if (state.visibility_m && *state.visibility_m < kFog_m)
    body["visibility_m"] = std::max(kThickest_m, rounded(*state.visibility_m));
  return body.dump();
}

void SimulatorWeather::follow(Clock::time_point now) {
  constexpr std::chrono::seconds kBetween(2);
  if (last_ && now - *last_ < kBetween) return;
  const std::optional<feeds::AircraftState> state = feed_.newest();
  if (!state || (!state->visibility_m && !state->rain_norm && !state->snow_norm)) return;
  last_ = now;
  // None told is not the same as nothing told.
  std::string told = weather_body(*state);
  for (const auto& one : {state->visibility_m, state->rain_norm, state->snow_norm})
    told += one ? '1' : '0';
  if (told == told_) return;
  told_ = std::move(told);
  refusal_.clear();
  try {
    desk_.change_weather(
        [&state](const atmosphere::Weather& weather) { return weather_body(*state, weather); });
  } catch (const core::InputError& error) {
    refusal_ = core::to_string(error.problems().front());
  }
}

}  // namespace fanbeam::live
