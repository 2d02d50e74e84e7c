// The sweep that makes one column of a scanning radar's B-scope.
//
// One ramp up per column, of the sensor's bandwidth B over its dwell T, about the frequency that
// points there (sensors/antenna/frequency_scan.h; without such a law every column has the
// carrier's). Complex samples are taken over the part T' of the ramp whose range bin
// c / (2 (B/T) T') is the sensor's range cell: T' = T where the cell is c / 2B. A tenth more samples
// than range cells up to the gate's end leave room for what Doppler shifts.
//
// The clock's zero is the middle of the sampled part: there a scatterer has the range of its
// core::Echo, and every column that of the frame's time (a frame is one instant, as in the
// picture of the renderer).
// Neglected: the way flown from column to column (4.4 m a scan at 70 m/s and 16 Hz), what
// frequency changes in gain and width of the beam (neglected_steering_dB of the sensor).
#pragma once

#include <string>

#include "sensors/sensor.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

// Why the sensor's columns cannot be made of beat signals, in words that follow "because"; empty
// where they can. They can where every column has a ramp of its own whose range bin is the range
// cell to 0.1 %: not with one sweep over the whole scan, nor with the published table's convention
// (SeedConvention), whose cell is none of a sweep.
std::string why_no_column_sweep(const sensors::Sensor& sensor);

// Throws InputError E-UNSUPPORTED with that reason, and what check(Waveform) does.
Waveform column_sweep(const sensors::Sensor& sensor, int column);

}  // namespace fanbeam::signal
