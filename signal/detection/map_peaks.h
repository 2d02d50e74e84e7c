// Local maxima among the cells that a detector reported, with their place between cells.
//
// A cell stays when none of its eight neighbours is stronger; of equal neighbours the first in the
// order of the map stays. Rows may wrap (Doppler). The place is that of the parabola through
// logarithms along either axis (signal/fourier/peak_fit.h): biased by up to 0.03 bins under a
// Taylor window without padding, less with wider windows; at edges that do not wrap it stays on the
// cell.
#pragma once

#include <vector>

#include "signal/detection/cfar.h"
#include "signal/transform/cube_maps.h"

namespace fanbeam::signal {

struct MapPeak {
  CfarCell cell;
  double row = 0.0;  // fractional
  double column = 0.0;
};

// In the order of the map.
std::vector<MapPeak> map_peaks(const PowerMap& map, const std::vector<CfarCell>& detected,
                               bool rows_wrap);

}  // namespace fanbeam::signal
