#include "session/products/detection_product.h"

#include <fmt/core.h>

#include <cmath>

#include "core/errors.h"
#include "core/units.h"
#include "sensors/cells.h"
#include "session/products/frame_table.h"

namespace fanbeam::session {

core::Picture8 detection_mask(const sensors::Sensor& sensor,
                              const std::vector<renderer::ThresholdDetection>& detections) {
  core::Picture8 mask{sensor.scan.columns, sensor.range.cells, {}};
  mask.pixels.assign(static_cast<std::size_t>(mask.columns) * static_cast<std::size_t>(mask.rows),
                     0);
  for (const renderer::ThresholdDetection& detection : detections)
    mask.pixels[static_cast<std::size_t>((mask.rows - 1 - detection.row) * mask.columns +
                                         detection.column)] = 255;
  return mask;
}

std::string detection_table(const sensors::Sensor& sensor, int frame, double time_s,
                            const core::Metadata& metadata,
                            const std::vector<renderer::ThresholdDetection>& detections) {
  std::string table = table_head("threshold detections", metadata) +
                      "frame,time_s,row,column,range_m,azimuth_deg,power_W,snr_dB\n";
  const double noise_W = sensor.noise_power_W();
  for (const renderer::ThresholdDetection& detection : detections)
    table += fmt::format("{},{},{},{},{:.2f},{:.3f},{:.6e},{:.2f}\n", frame,
                         core::number_text(time_s), detection.row, detection.column,
                         sensors::range_middle_m(sensor.range, detection.row),
                         core::degrees(sensors::column_middle_rad(sensor.scan, detection.column)),
                         detection.power_W, 10.0 * std::log10(detection.power_W / noise_W - 1.0));
  return table;
}

}  // namespace fanbeam::session
