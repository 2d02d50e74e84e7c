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

double rate_mm_per_h(const std::optional<double>& norm, double heaviest, double power) {
  return rounded(heaviest * std::pow(std::clamp(norm.value_or(0.0), 0.0, 1.0), power));
}

}  // namespace

std::string weather_body(const feeds::AircraftState& state) {
  constexpr double kFog_m = 1000.0, kThickest_m = 10.0;
  constexpr double kLeast_mm_per_h = 0.1;
  double rain = rate_mm_per_h(state.rain_norm, 22.0, 2.7);
  double snow = rate_mm_per_h(state.snow_norm, 7.0, 2.2);
  if (rain < kLeast_mm_per_h || snow > rain) rain = 0.0;
  if (snow < kLeast_mm_per_h || rain > 0.0) snow = 0.0;
  Json body{{"rain_rate_mm_per_h", rain}, {"snow_rate_mm_per_h", snow}};
  if (state.visibility_m && *state.visibility_m < kFog_m)
    body["visibility_m"] = std::max(kThickest_m, rounded(*state.visibility_m));
  return body.dump();
}

void SimulatorWeather::follow(Clock::time_point now) {
  constexpr std::chrono::seconds kBetween(2);
  if (last_ && now - *last_ < kBetween) return;
  const std::optional<feeds::AircraftState> state = feed_.newest();
  if (!state) return;
  last_ = now;
  std::string body = weather_body(*state);
  if (body == set_) return;
  set_ = std::move(body);
  refusal_.clear();
  try {
    desk_.control("/api/weather", set_);
  } catch (const core::InputError& error) {
    refusal_ = core::to_string(error.problems().front());
  }
}

}  // namespace fanbeam::live
