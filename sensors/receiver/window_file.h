// The sweep's window from the [waveform] table of a sensor file; keys in sensor_file.h.
#pragma once

#include "core/config_table.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

void read_window(core::ConfigTable& table, Waveform& waveform);

}  // namespace fanbeam::sensors
