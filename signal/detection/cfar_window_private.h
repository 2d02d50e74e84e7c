// The reference cells of a detector, as offsets from the cell under test in the order of the map,
// and the background that it reads from them.
#pragma once

#include <span>
#include <vector>

#include "signal/detection/cfar.h"

namespace fanbeam::signal {

struct CfarOffset {
  int row = 0;
  int column = 0;
  bool after = false;  // behind the cell under test
};

// Checks the settings. Those before the cell come first. E-RANGE for reaches below 0 or above
// 10000, none at all, or a fraction outside (0, 1].
std::vector<CfarOffset> cfar_offsets(const CfarSettings& settings);

// Whether the detector averages the cells before and after the cell on their own.
inline bool has_halves(CfarKind kind) {
  return kind == CfarKind::greatest_of || kind == CfarKind::smallest_of;
}

// Reference cells of `before` + `after`, with the rank that goes with their number.
CfarReference reference_of(const CfarSettings& settings, int before, int after);

// The estimate from reference.before cells and the reference.after behind them, in this order;
// may change it.
double cfar_background(const CfarReference& reference, std::span<double> cells);

}  // namespace fanbeam::signal
