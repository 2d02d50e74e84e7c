// A stage of a waveform as an array sees it: which segment feeds which chirp of which channel.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct Frame {
  Waveform waveform;
  Array array;
  std::vector<Segment> segments;  // of the stage
  CubeShape shape;
  double sample_rate_Hz = 0.0;
  int slots = 1;
  // All segments alike and evenly spaced, linear or flat: what the fast methods need.
  bool uniform = false;
  double interval_s = 0.0;  // between chirps of one channel, of a uniform frame

  const Segment& segment(int channel, int chirp) const {
    const int slot = slots == 1 ? 0 : array.transmitter_of(channel);
    return segments[static_cast<std::size_t>(chirp * slots + slot)];
  }
};

// Throws E-LIMIT where the samples of a frame, those of all chirps and channels, are more than
// kMostFrameSamples (0.8 GB of them). Both parts are to be valid.
void check_size(const Waveform& waveform, const Array& array);

// Checks both parts and the size of both together. E-UNSUPPORTED where an array in time division has another number of
// transmitters than the stage has slots.
Frame make_frame(const Waveform& waveform, int stage, const Array& array);

}  // namespace fanbeam::signal
