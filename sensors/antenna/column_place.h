// Where a direction lies among the columns of a picture, and how strongly their beams see it.
//
// The beam is an angle on the sky; columns of a plane scan count azimuth in the horizontal plane,
// where a direction at elevation e is cos(e) times as far aside.
#pragma once

#include <algorithm>
#include <cmath>

#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct ColumnPlace {
  double position = 0.0;     // in columns; whole numbers are their middles
  double sky = 1.0;          // angle on the sky over azimuth
  int first = 0, last = -1;  // columns whose beams reach it, inside the picture

  bool is_seen_by(int column) const { return column >= first && column <= last; }
};

inline ColumnPlace column_place(const Sensor& sensor, double azimuth_rad, double elevation_rad) {
  const Scan& scan = sensor.scan;
  const double width_rad = scan.column_width_rad();
  ColumnPlace place;
  place.sky = scan.surface == ScanSurface::plane ? std::cos(elevation_rad) : 1.0;
  place.position = (azimuth_rad + scan.field_of_view_rad / 2) / width_rad - 0.5;
  const double reach = reach_rad(sensor.antenna.azimuth) / (width_rad * std::max(place.sky, 0.01));
  place.first = std::max(0, static_cast<int>(std::ceil(place.position - reach)));
  place.last = std::min(scan.columns - 1, static_cast<int>(std::floor(place.position + reach)));
  return place;
}

// Two-way power gain of a column's beam towards the place, relative to its peak, side lobes
// included.
inline double column_gain(const Sensor& sensor, const ColumnPlace& place, int column) {
  return two_way_gain_with_side_lobes(
      sensor.antenna.azimuth,
      (column - place.position) * sensor.scan.column_width_rad() * place.sky);
}

}  // namespace fanbeam::sensors
