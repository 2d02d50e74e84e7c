// The reference cells of a detector, as offsets from the cell under test in the order of the map.
#pragma once

#include <vector>

#include "signal/detection/cfar.h"

namespace fanbeam::signal {

struct CfarOffset {
  int row = 0;
  int column = 0;
  bool after = false;  // behind the cell under test
};

// Checks the settings. E-RANGE for reaches below 0 or above 10000, none at all, or a fraction
// outside (0, 1].
std::vector<CfarOffset> cfar_offsets(const CfarSettings& settings);

// Reference cells of `before` + `after`, with the rank that goes with their number.
CfarReference reference_of(const CfarSettings& settings, int before, int after);

}  // namespace fanbeam::signal
