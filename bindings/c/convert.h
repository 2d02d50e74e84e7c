// Between the plain structs of fanbeam.h and those of core and the renderer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bindings/c/fanbeam.h"
#include "core/pose.h"
#include "sensors/sensor.h"

namespace fanbeam::bindings {

// Of values that were checked.
core::Pose pose_of(const fanbeam_pose& pose);
fanbeam_pose pose_of(const core::Pose& pose);

// Elements of a sensor's pictures.
struct Shape {
  std::size_t columns = 0, bscope_rows = 0, cscope_rows = 0;

  std::size_t bscope() const { return columns * bscope_rows; }
  std::size_t cscope() const { return columns * cscope_rows; }
};
Shape shape_of(const sensors::Sensor& sensor);

// A frame's events as bits.
std::uint32_t events_of(const std::vector<std::string>& events);

}  // namespace fanbeam::bindings
