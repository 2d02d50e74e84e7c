// How far a frame's sampling may have left it from the converged picture, in grey levels RMS over all
// cells: refinement.h.
#pragma once

#include <algorithm>

namespace fanbeam::renderer {

struct ErrorEstimate {
  double rms_grey = 0.0;         // of the B-scope, the main figure
  double cscope_rms_grey = 0.0;  // 0 without one
  int levels = 1;                // cast, at the column that took most
  // false: the finest level is still coarser than asked for, or raised obstacles differ (mode shadow)
  bool reached = true;

  double largest_grey() const { return std::max(rms_grey, cscope_rms_grey); }
};

}  // namespace fanbeam::renderer
