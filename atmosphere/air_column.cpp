#include "atmosphere/air_column.h"

#include "atmosphere/weather.h"

namespace fanbeam::atmosphere {
namespace {

std::variant<StandardAtmosphere, Sounding> air_of(const Weather& weather) {
  if (!weather.levels.empty())
    return Sounding(weather.levels, weather.origin_height_m, weather.pressure_hPa);
  return StandardAtmosphere(
      {weather.origin_height_m, weather.temperature_C, weather.pressure_hPa, weather.humidity});
}

}  // namespace

AirColumn::AirColumn(const Weather& weather)
    : origin_height_m_(weather.origin_height_m), air_(air_of(weather)) {}

AirState AirColumn::at(double height_m) const {
  return std::visit([&](const auto& air) { return air.at(origin_height_m_ + height_m); }, air_);
}

std::optional<double> AirColumn::zero_celsius_m() const {
  constexpr double kStep_m = 10.0;
  for (double high_m = kHighestWeather_m; high_m > kLowestWeather_m; high_m -= kStep_m) {
    double warm_m = high_m - kStep_m;
    if (temperature_C(warm_m) < 0.0) continue;
    double cold_m = high_m;
    if (temperature_C(cold_m) >= 0.0) return std::nullopt;
    while (cold_m - warm_m > 0.01) {
      const double middle_m = (warm_m + cold_m) / 2;
      (temperature_C(middle_m) >= 0.0 ? warm_m : cold_m) = middle_m;
    }
    return (warm_m + cold_m) / 2;
  }
  return std::nullopt;
}

}  // namespace fanbeam::atmosphere
