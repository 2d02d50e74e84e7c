// Tells of targets that are too large for their formula: the far field of an L metres long shape
// begins at 2 L^2 / lambda (233 m for 1 m at 35 GHz). Nearer, its parts do not add up in phase, and
// the cross-section of the far field is an upper bound of the peak in a lobe that is too narrow.
#pragma once

#include <string>

#include "core/errors.h"
#include "materials/rcs/rcs.h"
#include "sensors/sensor.h"

namespace fanbeam::scenes {

class NearField {
 public:
  explicit NearField(const sensors::Sensor& sensor) : sensor_(sensor) {}

  // Counts the target when its far field begins beyond the sensor's range window.
  void look_at(const materials::RcsModel& rcs, const std::string& name, const core::Place& place);

  // W-NEAR-FIELD once, for the first one, with the number of the others.
  void report(core::ProblemList& problems) const;

 private:
  const sensors::Sensor& sensor_;
  int count_ = 0;
  double far_field_m_ = 0.0;  // of the first
  std::string name_;
  core::Place place_;
};

}  // namespace fanbeam::scenes
