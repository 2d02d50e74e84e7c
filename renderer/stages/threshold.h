// Threshold detection of a B-scope: the cells whose received power is above a fixed power. The
// threshold knows the receiver's noise only (sensors/receiver/detection.h), so ground clutter above
// it is reported like any target.
#pragma once

#include <span>
#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::renderer {

struct ThresholdDetection {
  int row = 0;  // 0 is the nearest range cell
  int column = 0;
  double power_W = 0.0;  // received, with its noise
};

// In the order of the array; `received_W` as bscope_grey takes it.
std::vector<ThresholdDetection> above_threshold(const sensors::Sensor& sensor, double threshold_W,
                                                std::span<const double> received_W);

}  // namespace fanbeam::renderer
