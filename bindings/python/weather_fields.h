// The weather by the names that Python says it with: those of scene files, as keywords.
#pragma once

#include <pybind11/pybind11.h>

#include "atmosphere/weather.h"

namespace fanbeam::bindings {

// `changes` over `weather`: what it does not name stays. None takes a value away, as if nobody had
// said it (no rain, a top's default); visibility and liquid water take each other's place. Throws
// TypeError for a name that is not known. Values are checked where the weather is used.
atmosphere::Weather changed_weather(atmosphere::Weather weather, const pybind11::dict& changes);

pybind11::dict weather_dict(const atmosphere::Weather& weather);

}  // namespace fanbeam::bindings
