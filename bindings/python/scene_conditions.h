// What is set in a held scene: weather, surface, sensor, targets, sampling.
#pragma once

#include <pybind11/pybind11.h>

#include "bindings/python/scene_handle.h"

namespace fanbeam::bindings {

void add_conditions(pybind11::class_<Scene>& scene);

}  // namespace fanbeam::bindings
