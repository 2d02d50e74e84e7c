// Cuts of a beam in degrees.
#pragma once

#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::tests {

inline sensors::BeamCut cut_of(sensors::BeamCut::Shape shape, double width_deg, double cut_deg) {
  sensors::BeamCut cut;
  cut.shape = shape;
  cut.half_power_width_rad = core::radians(width_deg);
  cut.cut_rad = core::radians(cut_deg);
  return cut;
}

}  // namespace fanbeam::tests
