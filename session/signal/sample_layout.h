// What the axes and values of recorded samples mean (sample_file.h).
#pragma once

#include <string>
#include <vector>

namespace fanbeam::session {

struct SampleLayout {
  std::vector<std::string> axes;  // outermost first; empty: channel, chirp, sample
  double scale_sqrtW = 1.0;       // 1e-30 to 1e9
  bool conjugate = false;
  // What every channel's values, as recorded, are known to be too large and turned by; none: they are not.
  std::vector<double> channel_gains_dB, channel_phases_rad;
};

}  // namespace fanbeam::session
