// Frames for Python: arrays over the memory that they were rendered into.
#pragma once

#include <memory>

#include "bindings/python/convert.h"
#include "renderer/frame.h"
#include "scenes/scene.h"

namespace fanbeam::bindings {

// By the names of fanbeam.Frame's fields; what was not rendered is None. All pictures have the
// farthest range or the highest elevation on top.
pybind11::dict frame_dict(const std::shared_ptr<const renderer::Frame>& frame,
                          const renderer::Products& wanted, const sensors::Sensor& sensor);

}  // namespace fanbeam::bindings
