// What a picture shows before bounces are added: beside it an echo that takes several reflections
// counts, or does not.
//
// By strip of sub-columns and range cell, power at full azimuth gain: the surfaces' own, smoothed
// over the strips beside as the beam does, and the larger of the receiver's mean noise and the
// display's floor; less where the C-scope would show less. It does not depend on whether a C-scope
// is asked for: the B-scope has the same bytes.
// Guides the sampling of bounces, and changes no expected value.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

class BounceFloor {
 public:
  // Of `sums` with the surfaces alone, in strips of `sub_columns`.
  BounceFloor(const sensors::Sensor& sensor, bool noise, const FanSums& sums, int sub_columns);

  // For any range; that of the nearest cell outside the gate.
  double power_W(int strip, double range_m) const;

 private:
  double first_m_ = 0.0, cells_per_m_ = 0.0;
  int cells_ = 0;
  std::vector<double> power_W_;  // [strip][cell]
};

}  // namespace fanbeam::renderer
