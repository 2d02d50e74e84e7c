// The product "detections": a mask picture and a table per frame.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "renderer/stages/threshold.h"
#include "sensors/sensor.h"

namespace fanbeam::session {

// 255 where something was detected, 0 elsewhere; laid out as the B-scope, farthest range on top.
core::Picture8 detection_mask(const sensors::Sensor& sensor,
                              const std::vector<renderer::ThresholdDetection>& detections);

// One line per detection under the frame's metadata as comments and the column names:
// frame, time_s, row (0 nearest), column (0 left), range_m and azimuth_deg of the cell's middle,
// power_W with its noise, snr_dB: power over mean noise, less the noise.
std::string detection_table(const sensors::Sensor& sensor, int frame, double time_s,
                            const core::Metadata& metadata,
                            const std::vector<renderer::ThresholdDetection>& detections);

}  // namespace fanbeam::session
