// fanbeam.Scene's own part of the module.
#pragma once

#include <pybind11/pybind11.h>

namespace fanbeam::bindings {

void add_scene(pybind11::module_& module);

}  // namespace fanbeam::bindings
