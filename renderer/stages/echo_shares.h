// How a point scatterer's echo is shared out among the cells of a picture: one range cell (and one
// C-scope row), every column whose beam reaches it, weighted with the two-way azimuth pattern.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/echo.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// Calls share(range cell, column, power in W) for every column that the echo reaches; never for an
// echo outside the range gate.
template <class Share>
void share_echo(const core::Echo& echo, const sensors::Sensor& sensor, const Share& share) {
  const sensors::Scan& scan = sensor.scan;
  const double width_rad = scan.column_width_rad();
  // The beam is an angle on the sky; columns of a plane scan count azimuth in the horizontal
  // plane.
  const double sky =
      scan.surface == sensors::ScanSurface::plane ? std::cos(echo.elevation_rad) : 1.0;
  const int cell = sensors::range_row(sensor.range, echo.range_m);
  if (cell == sensors::kOutside) return;
  const double position = (echo.azimuth_rad + scan.field_of_view_rad / 2) / width_rad - 0.5;
  const double reach =
      sensors::reach_rad(sensor.antenna.azimuth) / (width_rad * std::max(sky, 0.01));
  const int first = std::max(0, static_cast<int>(std::ceil(position - reach)));
  const int last = std::min(scan.columns - 1, static_cast<int>(std::floor(position + reach)));
  for (int column = first; column <= last; ++column)
    share(cell, column,
          echo.power_W * sensors::two_way_gain_with_side_lobes(
                             sensor.antenna.azimuth, (column - position) * width_rad * sky));
}

}  // namespace fanbeam::renderer
