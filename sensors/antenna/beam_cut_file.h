// One cut of an antenna pattern from its table in a sensor file; keys and ranges in sensor_file.h.
#pragma once

#include <optional>
#include <string>

#include "core/config_table.h"
#include "sensors/antenna/pattern_file.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct ReadCut {
  BeamCut cut;
  std::string file;                      // that the cut was read from
  std::optional<double> file_peak_gain;  // what a pattern file says of the antenna's gain, linear
};

// `boresight_elevation_rad` counts for the elevation only. Problems are reported through the table;
// the cut is usable only when there was none.
ReadCut read_beam_cut(core::ConfigTable& table, PatternPlane plane, double boresight_elevation_rad);

}  // namespace fanbeam::sensors
