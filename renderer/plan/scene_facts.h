// What the effect catalogue's bounds may use of a scene.
#pragma once

#include "atmosphere/weather.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// The sensor, the weather and the heights that rays pass through (above the scene's origin).
struct SceneFacts {
  atmosphere::Weather weather;
  sensors::Sensor sensor;
  double lowest_m = 0.0;  // of ground and sensor
  double highest_m = 0.0;
};

}  // namespace fanbeam::renderer
