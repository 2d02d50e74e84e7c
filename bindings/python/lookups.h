// Materials and the air for Python, without a scene.
#pragma once

#include <pybind11/pybind11.h>

namespace fanbeam::bindings {

void add_lookups(pybind11::module_& module);

}  // namespace fanbeam::bindings
