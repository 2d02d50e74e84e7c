// The antenna of a sensor file; keys and ranges in sensor_file.h.
#pragma once

#include "core/config_table.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

// Problems are reported through the table; the antenna is usable only when there was none.
void read_antenna(core::ConfigTable table, Antenna& antenna);

// A gain above the directivity would create energy. Also sets the efficiency. For an antenna that
// was read without errors.
void check_gain(core::ConfigTable table, Antenna& antenna);

}  // namespace fanbeam::sensors
