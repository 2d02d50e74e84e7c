#include "scenes/weather_placement.h"

namespace fanbeam::scenes {

atmosphere::Weather placed_weather(const SceneDescription& scene, const Ground& ground) {
  atmosphere::Weather weather = scene.weather;
  for (const RainCellDescription& described : scene.rain_cells) {
    const std::optional<glm::dvec2> at_m = ground.local_m(described.at);
    if (!at_m) continue;
    weather.rain_cells.push_back(described.cell);
    weather.rain_cells.back().centre_m = *at_m;
  }
  return weather;
}

void check_losses(const atmosphere::Weather& weather, core::ProblemList& problems) {
  const auto check = [&](const char* field, bool simulated) {
    if (!simulated)
      problems.error(core::ErrorClass::unsupported, {}, field, "false",
                     "true: effects are chosen by BuildOptions::wishes");
  };
  check("simulate_gas", weather.simulate_gas);
  check("simulate_fog", weather.simulate_fog);
  check("simulate_rain", weather.simulate_rain);
  check("simulate_snow", weather.simulate_snow);
}

}  // namespace fanbeam::scenes
