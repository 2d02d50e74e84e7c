// How a point scatterer's echo is shared out among the cells of a picture: one range cell (and one
// C-scope row), every column whose beam reaches it, weighted with the two-way azimuth pattern.
#pragma once

#include "core/echo.h"
#include "sensors/antenna/column_place.h"
#include "sensors/cells.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// Calls share(range cell, column, power in W) for every column that the echo reaches; never for an
// echo outside the range gate.
template <class Share>
void share_echo(const core::Echo& echo, const sensors::Sensor& sensor, const Share& share) {
  const int cell = sensors::range_row(sensor.range, echo.range_m);
  if (cell == sensors::kOutside) return;
  const sensors::ColumnPlace place =
      sensors::column_place(sensor, echo.azimuth_rad, echo.elevation_rad);
  for (int column = place.first; column <= place.last; ++column)
    if (place.is_seen_by(column))
      share(cell, column, echo.power_W * sensors::column_gain(sensor, place, column));
}

}  // namespace fanbeam::renderer
