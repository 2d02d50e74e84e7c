// One cut of an antenna pattern from its table in a sensor file; keys and ranges in sensor_file.h.
#pragma once

#include "core/config_table.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

// Problems are reported through the table; the cut is usable only when there was none.
BeamCut read_beam_cut(core::ConfigTable& table);

}  // namespace fanbeam::sensors
