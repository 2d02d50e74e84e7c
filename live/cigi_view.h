// What a CIGI host's View Definition and Sensor Control make of the pictures of a frame.
//
// The sensor scans what it scans; cells beyond the wanted ranges and sector are blanked, as a radar's
// range gate and sector blanking do: near and far cells of the B-scope (a C-scope has no ranges), columns
// left and right, rows of the C-scope above and below, each by its middle. Azimuths and elevations count
// from the axes of the picture. A sensor that is off shows black; black-hot turns grey around. Watts
// (LiveFrame::received_W) of blanked cells and of a sensor that is off are 0.
#pragma once

#include "feeds/cigi/host_packets.h"
#include "live/hub.h"
#include "sensors/sensor.h"

namespace fanbeam::live {

struct CigiView {
  feeds::cigi::ViewDefinition window;
  bool on = true, black_hot = false;
};

// The frame's sizes are the sensor's.
void show(const CigiView& view, const sensors::Sensor& sensor, LiveFrame& frame);

}  // namespace fanbeam::live
