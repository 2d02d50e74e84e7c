// A range-azimuth map seen from above: cells of equal size, forward against right.
//
// Each cell takes the power at its centre by bilinear interpolation between the four neighbours in
// range and azimuth: a cell at a map cell's own place has its power exactly, and a power never
// leaves the interval of its neighbours. Cells beyond the map's azimuths or its last range are 0. A
// map that begins at -90 deg ends at 90 deg with the same cell: at a pitch of half a wavelength or less
// the cell after the last is the first again. Of rows beyond end-fire (a pitch below half a wavelength;
// angle_cell_azimuths_rad tells them as +-90 deg) the innermost of each side alone is looked at.
// Power is per map cell, not per area: sums over the picture mean nothing.
#pragma once

#include <vector>

#include "signal/transform/cube_maps.h"

namespace fanbeam::signal {

struct TopViewGrid {
  double nearest_m = 0.0;   // forward, centre of the first row
  double leftmost_m = 0.0;  // right, centre of the first column
  double step_m = 1.0;
  int rows = 0;     // away from the radar
  int columns = 0;  // to the right
};

// `range_azimuth` has a row for each of `azimuths_rad`, which must increase but at +-90 deg, and a column for each
// range, `range_step_m` apart from 0. E-RANGE otherwise.
PowerMap top_view(const PowerMap& range_azimuth, const std::vector<double>& azimuths_rad,
                  double range_step_m, const TopViewGrid& grid);

}  // namespace fanbeam::signal
