// How a sensor's frequency sweeps relate to its scan, from the [scan] table of a sensor file; keys
// and ranges in sensor_file.h.
#pragma once

#include "core/config_table.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

// `sweep`, `steering` and [scan.frequency_scan]. Problems are reported through the table.
void read_sweep(core::ConfigTable& table, Scan& scan);

// What takes scan and waveform together; of a sensor that was read without errors.
void check_sweep(core::ConfigTable scan, core::ConfigTable waveform, const Sensor& sensor);

}  // namespace fanbeam::sensors
