// The power that each visible piece of a slice sends back, and where it falls: loops over columns,
// which the compiler turns into vector code. The equation and its errors: slice_power.h.
#pragma once

#include <cstdint>

#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/profile/power_tables.h"
#include "renderer/casting/profile/slice.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

struct PiecePowers {
  template <class T>
  using Column = VisiblePieces::Column<T>;
  enum Kind : std::int32_t {
    plain,
    two_cells,   // to be halved at the border that it passes
    many_cells,  // to be cut at every border
    wedge,       // an oblique wall: spreads over the ranges it takes in the wedge
    many_rows    // and from here on: over more than two elevation rows, or over the picture's rim
  };
  alignas(64) Column<std::int32_t> kind;
  alignas(64) Column<double> near_range_m, far_range_m;
  // The parts before and behind a border of range cells; the sink behind the gate takes what is
  // outside it and what is not plain.
  alignas(64) Column<std::int32_t> before_cell, behind_cell;
  // From integrate() the integral alone, in 1/m^2; power from weigh() on.
  alignas(64) Column<double> before_W_per_rad, behind_W_per_rad;
  alignas(64) Column<double> border_share;  // of the piece's length, where the border cuts it
  alignas(64) Column<double> distance_m, height_m, range_m;  // of the middle
  // Positions in elevation rows from the top of the picture, as real numbers.
  alignas(64) Column<double> high_row, low_row;
  // The row, counted from 1, that takes `row_share` of the power times R^3; the next one takes the
  // rest. Row 0 is a sink.
  alignas(64) Column<std::int32_t> row;
  alignas(64) Column<double> row_share, row_W_m3_per_rad;
  int count = 0;
};

// The sine of the antenna's elevation of a point of the slice is
// (along * distance + up * height) / range.
struct SineWeights {
  double along, up;
};

// Cells and integrals.
// `most_rad` of most_elevation_rad().
void integrate(const sensors::RangeGate& gate, double most_rad, const VisiblePieces& pieces,
               PiecePowers& powers);

// Pattern (`gain` by the sine of the elevation), NRCS and the radar constant.
void weigh(const PowerTables& tables, const double* gain, const SineWeights& weights,
           double constant_W_m2, const VisiblePieces& pieces, PiecePowers& powers);

void lose_on_path(const PathLossTable& path_loss, double sensor_height_m, PiecePowers& powers);

// Which rows the ends of the pieces lie in.
void place_in_rows(const PowerTables& tables, const SineWeights& weights,
                   const VisiblePieces& pieces, PiecePowers& powers);

// How the power of plain pieces falls on two rows; those over more, or partly outside, are told.
void share_rows(int rows_in_picture, int cells_in_gate, PiecePowers& powers);

}  // namespace fanbeam::renderer
