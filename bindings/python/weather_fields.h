// The weather by the names that Python says it with: those of scene files, as keywords.
#pragma once

#include <pybind11/pybind11.h>

#include "atmosphere/weather.h"

namespace fanbeam::bindings {

// `changes` over `weather`: what it does not name stays. None takes a value away, as if nobody had
// said it (no rain, a top's default). Visibility and liquid water take each other's place, and None
// for either ends the fog that the other tells. Throws TypeError for a name that is not known and for
// a value of another type, and InputError with all that is wrong where a number is too large to be
// held; else values are checked where the weather is used, both ways of telling the fog together too.
atmosphere::Weather changed_weather(atmosphere::Weather weather, const pybind11::dict& changes,
                                    double frequency_Hz);

pybind11::dict weather_dict(const atmosphere::Weather& weather);

}  // namespace fanbeam::bindings
