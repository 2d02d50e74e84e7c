// Which cell of a picture a range or an angle falls into. Cells are half open and share their
// edges, so that every value inside belongs to exactly one of them; edges are compared as
// evaluated in double, never through a division.
//
//   range row k      [minimum + k cell, minimum + (k + 1) cell), 0 nearest
//   azimuth column k [edge k, edge k + 1), 0 leftmost,
//                    edge k = field of view (2k - columns) / (2 columns)
//   C-scope row k    (top - (k + 1) height, top - k height], 0 highest
// The outermost right, far and lower edges are outside. A scan of 360 deg has no outside: +-180
// deg is column 0.
// -1 means outside, also for NaN and infinity. Valid: counts of at least 1, cell sizes above 0.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

inline constexpr int kOutside = -1;

inline double range_edge_m(const RangeGate& gate, int row) {
  return gate.minimum_m + row * gate.cell_m;
}

inline double range_middle_m(const RangeGate& gate, int row) {
  return gate.minimum_m + (row + 0.5) * gate.cell_m;
}

inline double column_edge_rad(const Scan& scan, int column) {
  return scan.field_of_view_rad * ((2.0 * column - scan.columns) / (2.0 * scan.columns));
}

inline double column_middle_rad(const Scan& scan, int column) {
  return scan.field_of_view_rad * ((2.0 * column + 1.0 - scan.columns) / (2.0 * scan.columns));
}

// Depth below the window's top.
inline double cscope_edge_rad(const Display& display, int row) {
  return display.cscope_span_rad * (static_cast<double>(row) / display.cscope_rows);
}

// The cell whose edges hold `value`, starting from a guess that rounding may have put beside it.
template <class Edge>
int cell_holding(double value, double guess, int cells, const Edge& edge) {
  if (!(value >= edge(0) && value < edge(cells))) return kOutside;
  int cell = static_cast<int>(std::clamp(guess, 0.0, cells - 1.0));
  while (value < edge(cell)) --cell;
  while (value >= edge(cell + 1)) ++cell;
  return cell;
}

inline int range_row(const RangeGate& gate, double range_m) {
  return cell_holding(range_m, (range_m - gate.minimum_m) / gate.cell_m, gate.cells,
                      [&](int row) { return range_edge_m(gate, row); });
}

inline int azimuth_column(const Scan& scan, double azimuth_rad) {
  const bool all_round = scan.field_of_view_rad >= 2.0 * core::kPi * (1.0 - 1e-15);
  if (all_round && std::isfinite(azimuth_rad)) {
    if (!(azimuth_rad >= -core::kPi && azimuth_rad < core::kPi))
      azimuth_rad = core::wrap_pi_rad(azimuth_rad);
    // The outermost edges may lie a rounding inside +-pi.
    azimuth_rad = std::clamp(azimuth_rad, column_edge_rad(scan, 0),
                             std::nextafter(column_edge_rad(scan, scan.columns), 0.0));
  }
  const double guess = (azimuth_rad / scan.field_of_view_rad + 0.5) * scan.columns;
  return cell_holding(azimuth_rad, guess, scan.columns,
                      [&](int column) { return column_edge_rad(scan, column); });
}

inline int cscope_row(const Display& display, double elevation_rad) {
  const double depth_rad = display.cscope_top_rad - elevation_rad;
  return cell_holding(depth_rad, depth_rad / display.cscope_span_rad * display.cscope_rows,
                      display.cscope_rows, [&](int row) { return cscope_edge_rad(display, row); });
}

}  // namespace fanbeam::sensors
