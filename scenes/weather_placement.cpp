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

}  // namespace fanbeam::scenes
