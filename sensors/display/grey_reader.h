// The keys of [display] that say how power becomes grey, alike in sensor files and scenes:
// mapping, low_dB and high_dB.
#pragma once

#include "core/config_table.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

// `display` holds what counts where a key is missing. A window is in dB of NRCS or, for "log", in
// dBW: a table that changes from one to the other needs both ends. "seed" has a window of its own,
// which needs a window of range that begins above 0.
void read_grey_mapping(core::ConfigTable& table, const RangeGate& range, Display& display);

}  // namespace fanbeam::sensors
