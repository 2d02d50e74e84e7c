// Where visible pieces begin and end, for ground truth's cells. Private to the layers, part of its loops.
#pragma once

#include <cmath>
#include <cstdint>

#include "renderer/casting/profile/piece_loops.h"
#include "renderer/casting/profile/slice_tracer.h"
#include "renderer/stages/layer_slices.h"
#include "renderer/surfaces/nrcs_table.h"

namespace fanbeam::renderer {

// Of each piece, side by side for the vector units: its lower end and how the upper one differs.
struct PieceEnds {
  using Column = VisiblePieces::Column<double>;
  alignas(64) Column low_per_m, way_per_m, per_way_m;  // inverse ranges; 1 over their difference
  alignas(64) Column middle_per_m;
  alignas(64) Column facet_m;         // from the sensor to the facet's plane
  alignas(64) Column nrcs, nrcs_way;  // sigma0 / sin(psi)
  alignas(64) Column per_rows;
  // Of the middle: sine of the grazing angle, sigma0, elevation.
  alignas(64) Column middle_sine, middle_nrcs, middle_rad;
  alignas(64) Column nearest_m, farthest_m;  // at any azimuth of the piece
  using Numbers = VisiblePieces::Column<std::int32_t>;
  alignas(64) Numbers first_cell, last_cell;  // -1 before the gate, `cells` behind it
  alignas(64) Numbers first_row, last_row;    // none: the last before the first
  alignas(64) Numbers one_row;                // 1: all of it is in one
};

inline double between_0_and_1(double value) {
  const double not_below = value > 0.0 ? value : 0.0;
  return not_below < 1.0 ? not_below : 1.0;
}

// Whole numbers of all pieces at once: asked for one by one they took a tenth to a seventh of the time of sorting.
inline void find_cells(const LayerGrid& grid, const VisiblePieces& pieces,
                       const PiecePowers& powers, PieceEnds& ends) {
  const In near_m = powers.near_range_m.data(), far_m = powers.far_range_m.data();
  const In nearer_m = pieces.nearer_m.data(), farther_m = pieces.farther_m.data();
  const Out nearest_m = ends.nearest_m.data(), farthest_m = ends.farthest_m.data();
  std::int32_t* const first_cell = ends.first_cell.data();
  std::int32_t* const last_cell = ends.last_cell.data();
  const double minimum_m = grid.minimum_m, cells_per_m = grid.cells_per_m;
  const double behind = grid.cells + 0.0;
  const auto cell_of = [=](double range_m) {
    const double place = (range_m - minimum_m) * cells_per_m;
    const double not_before = place > -1.0 ? place : -1.0;
    return static_cast<std::int32_t>((not_before < behind ? not_before : behind) + 1.0) - 1;
  };
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double a_m = near_m[i], b_m = far_m[i];
    nearest_m[i] = (a_m < b_m ? a_m : b_m) + nearer_m[i];
    farthest_m[i] = (a_m < b_m ? b_m : a_m) + farther_m[i];
    first_cell[i] = cell_of(nearest_m[i]);
    last_cell[i] = cell_of(farthest_m[i]);
  }
}

inline void find_rows(const LayerGrid& grid, const PiecePowers& powers, PieceEnds& ends) {
  const In high_row = powers.high_row.data(), low_row = powers.low_row.data();
  std::int32_t* const first_row = ends.first_row.data();
  std::int32_t* const last_row = ends.last_row.data();
  std::int32_t* const one_row = ends.one_row.data();
  const double rows = grid.rows, lowest = rows - 0.5;
  const int count = powers.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double high = high_row[i], low = low_row[i];
    const bool seen = (low >= 0.0) & (high < rows);
    const double top = (seen & (high > 0.0)) ? high : 0.0;
    const double bottom = low < lowest ? low : lowest;
    const auto first = static_cast<std::int32_t>(top);
    const auto last = static_cast<std::int32_t>(seen ? bottom : -1.0);
    first_row[i] = first;
    last_row[i] = last;
    one_row[i] = (high >= 0.0) & (low < rows) & (first == last);
  }
}

inline void find_ends(const LayerGrid& grid, const double* nrcs, const VisiblePieces& pieces,
                      const PiecePowers& powers, PieceEnds& ends) {
  const double top_rad = grid.top_rad, rad_per_row = grid.rad_per_row;
  const Out middle_sine = ends.middle_sine.data(), middle_nrcs = ends.middle_nrcs.data();
  const Out middle_rad = ends.middle_rad.data();
  const In near_m = powers.near_range_m.data(), far_m = powers.far_range_m.data();
  const In range_m = powers.range_m.data(), facet_m = pieces.facet_m.data();
  const In facet_d2 = pieces.facet_d2.data();
  const In high_row = powers.high_row.data(), low_row = powers.low_row.data();
  const std::int32_t* material = pieces.material.data();
  const Out low_per_m = ends.low_per_m.data(), way_per_m = ends.way_per_m.data();
  const Out per_way_m = ends.per_way_m.data(), middle_per_m = ends.middle_per_m.data();
  const Out to_plane_m = ends.facet_m.data(), per_rows = ends.per_rows.data();
  const Out low_nrcs = ends.nrcs.data(), nrcs_way = ends.nrcs_way.data();
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double low = 1.0 / near_m[i], high = 1.0 / far_m[i];
    const double way = high - low, span = low_row[i] - high_row[i];
    const double plane_m = facet_m[i] / std::sqrt(facet_d2[i]);
    low_per_m[i] = low;
    way_per_m[i] = way;
    per_way_m[i] = way != 0.0 ? 1.0 / way : 0.0;
    middle_per_m[i] = 1.0 / range_m[i];
    to_plane_m[i] = plane_m;
    per_rows[i] = span > 0.0 ? 1.0 / span : 0.0;
    double low_share = 0.0, high_share = 0.0;
    const int table = material[i] * NrcsTable::kEntries;
    const int l = table + NrcsTable::index_of(between_0_and_1(plane_m * low), low_share);
    const int h = table + NrcsTable::index_of(between_0_and_1(plane_m * high), high_share);
    const double value = nrcs[l] + (nrcs[l + 1] - nrcs[l]) * low_share;
    low_nrcs[i] = value;
    const double difference = nrcs[h] + (nrcs[h + 1] - nrcs[h]) * high_share - value;
    nrcs_way[i] = difference;
    const double sine = between_0_and_1(plane_m * middle_per_m[i]);
    middle_sine[i] = sine;
    middle_nrcs[i] = (value + difference / 2) * sine;
    middle_rad[i] = top_rad - (low_row[i] + high_row[i]) / 2 * rad_per_row;
  }
}

}  // namespace fanbeam::renderer
