// Where a direction lies among the columns of a picture, and how strongly their beams see it.
//
// The beam is an angle on the sky; columns of a plane scan count azimuth in the horizontal plane,
// where a direction at elevation e is cos(e) times as far aside. A beam that reaches past +-180 deg
// reaches the columns on the other side.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct ColumnPlace {
  double position = 0.0;     // in columns; whole numbers are their middles
  double sky = 1.0;          // angle on the sky over azimuth
  double reach = 0.0;        // of the beam, in columns
  double circle = 0.0;       // in columns, where beams reach it past +-180 deg; else 0
  int first = 0, last = -1;  // columns inside the picture beyond which no beam reaches it

  // How many columns it lies right of a column's middle, the shorter way round.
  double right_of(int column) const {
    const double right = position - column;
    return circle > 0.0 ? std::remainder(right, circle) : right;
  }
  bool is_seen_by(int column) const {
    return column >= first && column <= last &&
           (circle == 0.0 || std::abs(right_of(column)) <= reach);
  }
};

// How far aside of its azimuth, as columns count it, a beam of that elevation reaches.
inline double azimuth_reach_rad(const Sensor& sensor, double elevation_rad) {
  const double sky = sensor.scan.surface == ScanSurface::plane ? std::cos(elevation_rad) : 1.0;
  return reach_rad(sensor.antenna.azimuth) / std::max(sky, 0.01);
}

// The steepest elevation that a beam reaches, up or down, side lobes included: at most pi / 2.
inline double steepest_rad(const Sensor& sensor) {
  return std::min(
      std::abs(sensor.antenna.boresight_elevation_rad) + reach_rad(sensor.antenna.elevation),
      core::kPi / 2);
}

// Whether the beam of any azimuth within the scan reaches that direction.
inline bool in_columns(const Sensor& sensor, double azimuth_rad, double elevation_rad) {
  return std::abs(azimuth_rad) <=
         sensor.scan.field_of_view_rad / 2 + azimuth_reach_rad(sensor, elevation_rad);
}

inline ColumnPlace column_place(const Sensor& sensor, double azimuth_rad, double elevation_rad) {
  const Scan& scan = sensor.scan;
  const double width_rad = scan.column_width_rad();
  ColumnPlace place;
  place.sky = scan.surface == ScanSurface::plane ? std::cos(elevation_rad) : 1.0;
  place.position = (azimuth_rad + scan.field_of_view_rad / 2) / width_rad - 0.5;
  place.reach = azimuth_reach_rad(sensor, elevation_rad) / width_rad;
  const double circle = 2.0 * core::kPi / width_rad;
  const int last_column = scan.columns - 1;
  if (place.position + circle - place.reach <= last_column ||
      place.position - circle + place.reach >= 0.0) {
    place.circle = circle;
    place.last = last_column;
    return place;
  }
  place.first = std::max(0, static_cast<int>(std::ceil(place.position - place.reach)));
  place.last = std::min(last_column, static_cast<int>(std::floor(place.position + place.reach)));
  return place;
}

// Two-way power gain of a column's beam towards the place, relative to its peak, side lobes
// included.
inline double column_gain(const Sensor& sensor, const ColumnPlace& place, int column) {
  return two_way_gain_with_side_lobes(
      sensor.antenna.azimuth, place.right_of(column) * sensor.scan.column_width_rad() * place.sky);
}

}  // namespace fanbeam::sensors
