#include "renderer/stages/threshold.h"

namespace fanbeam::renderer {

std::vector<ThresholdDetection> above_threshold(const sensors::Sensor& sensor, double threshold_W,
                                                std::span<const double> received_W) {
  std::vector<ThresholdDetection> detections;
  const int columns = sensor.scan.columns;
  for (int row = 0; row < sensor.range.cells; ++row)
    for (int column = 0; column < columns; ++column) {
      const double power_W = received_W[static_cast<std::size_t>(row * columns + column)];
      if (power_W > threshold_W) detections.push_back({row, column, power_W});
    }
  return detections;
}

}  // namespace fanbeam::renderer
