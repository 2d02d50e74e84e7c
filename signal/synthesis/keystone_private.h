// The axes of a keystone grid and the places of paths on them.
#pragma once

#include <vector>

#include "signal/scatter_path.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/wave_grid_private.h"

namespace fanbeam::signal {

struct WaveAxis {
  double first = 0.0, step = 1.0;
  int cells = 1;
  double cell(double value) const { return (value - first) / step; }
};

struct KeystoneAxes {
  WaveAxis rate;          // tau' k
  WaveAxis sine_s_per_m;  // u k / c
  int delays = 0;
  double reference_s = 0.0;  // mid frame
};

// Channels whose virtual elements lie beside each other: at one place forward and up.
struct ElementRow {
  double forward_m = 0.0, up_m = 0.0;
  std::vector<int> channels;
};

// What a path is in these variables, and what the variables leave out.
struct KeystonePath {
  double rate = 0.0, sine_s_per_m = 0.0, delay_turns_per_sample = 0.0;
  std::complex<double> value;
  double error_rad = 0.0;
};

// Frequency transmitted at a sample.
double sample_frequency_Hz(const Frame& frame, int sample);
// Position of a channel's virtual element along its row.
double element_m(const Frame& frame, int channel);

// In the order of their first channels.
std::vector<ElementRow> element_rows(const Frame& frame);

// As the row sees them.
std::vector<KeystonePath> keystone_paths(const Frame& frame, const ElementRow& row,
                                         double reference_s, const std::vector<ScatterPath>& paths);
KeystoneAxes keystone_axes(const Frame& frame, const std::vector<KeystonePath>& paths, int width,
                           double reference_s);

}  // namespace fanbeam::signal
