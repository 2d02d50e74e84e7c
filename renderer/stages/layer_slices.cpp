#include "renderer/stages/layer_slices.h"

#include <algorithm>
#include <cmath>

#include "core/dispatch.h"
#include "renderer/casting/profile/piece_loops.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/layer_pieces.h"
#include "renderer/stages/piece_ends.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

constexpr double kLeast_m2 = 1e-12;  // nothing is at the sensor

struct Buffers {
  SweepScratch scratch;
  VisiblePieces pieces, parts;
  PiecePowers powers;
};

Buffers& buffers_of_thread() {
  thread_local Buffers buffers;
  return buffers;
}

// Ranges and the integral of slice_power.h by its middle: what weigh() and place_in_rows() go on from.
FANBEAM_HOT(void, measure_middles, (const VisiblePieces& pieces, PiecePowers& powers),
            (pieces, powers)) {
  const In near_distance_m = pieces.near_distance_m.data();
  const In near_height_m = pieces.near_height_m.data();
  const In far_distance_m = pieces.far_distance_m.data();
  const In far_height_m = pieces.far_height_m.data();
  const In cross_m2 = pieces.cross_m2.data(), share = pieces.share.data();
  const Out near_m = powers.near_range_m.data(), far_m = powers.far_range_m.data();
  const Out distance_m = powers.distance_m.data(), height_m = powers.height_m.data();
  const Out before_per_m2 = powers.before_W_per_rad.data();
  const Out behind_per_m2 = powers.behind_W_per_rad.data();
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double d1_m = near_distance_m[i], z1_m = near_height_m[i];
    const double d2_m = far_distance_m[i], z2_m = far_height_m[i];
    const double d_m = (d1_m + d2_m) / 2, z_m = (z1_m + z2_m) / 2;
    const double square_m2 = d_m * d_m + z_m * z_m + kLeast_m2;
    const double facing_m2 = cross_m2[i] > 0.0 ? cross_m2[i] : 0.0;
    near_m[i] = std::sqrt(d1_m * d1_m + z1_m * z1_m + kLeast_m2);
    far_m[i] = std::sqrt(d2_m * d2_m + z2_m * z2_m + kLeast_m2);
    distance_m[i] = d_m;
    height_m[i] = z_m;
    before_per_m2[i] = share[i] * facing_m2 / (square_m2 * square_m2);
    behind_per_m2[i] = 0.0;
  }
  powers.count = count;
}

// One piece on its way into the cells. All of it is part of the loop over pieces: a call out of code of
// the machine's level would cost more than what is called.
struct PieceInCells {
  const LayerGrid& grid;
  const VisiblePieces& pieces;
  const PiecePowers& powers;
  const PieceEnds& ends;
  AzimuthMask azimuths;
  int i;

  // What a cell has of it, around a share of its elevations and an inverse range.
  [[gnu::always_inline]] LayerEcho part(double share, double per_m, double power_W) const {
    const double sine = between_0_and_1(ends.facet_m[i] * per_m);
    const double row = powers.low_row[i] + share * (powers.high_row[i] - powers.low_row[i]);
    return {.power_W = power_W,
            .sin_grazing = sine,
            .nrcs = (ends.nrcs[i] + share * ends.nrcs_way[i]) * sine,
            .elevation_rad = static_cast<float>(grid.top_rad - row * grid.rad_per_row),
            .object = pieces.object[i],
            .material = static_cast<terrain::MaterialId>(pieces.material[i])};
  }
  // All of it in one cell.
  [[gnu::always_inline]] LayerEcho middle() const {
    return {.power_W = powers.before_W_per_rad[i],
            .range_m = powers.range_m[i],
            .sin_grazing = ends.middle_sine[i],
            .nrcs = ends.middle_nrcs[i],
            .elevation_rad = static_cast<float>(ends.middle_rad[i]),
            .object = pieces.object[i],
            .material = static_cast<terrain::MaterialId>(pieces.material[i])};
  }
  // Walls, roofs and the rim of the ground beside the antenna's pattern are among the pieces.
  [[gnu::always_inline]] void put(int cell, AzimuthMask at, const LayerEcho& echo,
                                  LayerCells& cells) const {
    const auto elevation_rad = static_cast<double>(echo.elevation_rad);
    if (elevation_rad > grid.lowest_rad && elevation_rad < grid.highest_rad)
      cells.add(cell, at, echo);
  }
  [[gnu::always_inline]] void add_ranges(LayerCells& ranges) const {
    const double near_m = ends.nearest_m[i], far_m = ends.farthest_m[i];
    const int first = ends.first_cell[i], last = ends.last_cell[i];
    if (first == last) {
      if (first >= 0 && first < grid.cells) put(first, azimuths, middle(), ranges);
    } else if (pieces.farther_m[i] > pieces.nearer_m[i]) {
      spread(near_m, far_m, first, last, ranges);
    } else {
      cut(near_m, far_m, first, last, ranges);
    }
  }

  [[gnu::always_inline]] void cut(double near_m, double far_m, int first, int last,
                                  LayerCells& ranges) const {
    const double whole_W = powers.before_W_per_rad[i] * std::abs(ends.per_way_m[i]) *
                           powers.range_m[i] * powers.range_m[i];
    double from_per_m = first < 0 ? grid.nearest_per_m : 1.0 / near_m;
    for (int cell = std::max(first, 0); cell <= std::min(last, grid.cells - 1); ++cell) {
      const double to_per_m =
          cell == last ? 1.0 / far_m : grid.border_per_m[static_cast<std::size_t>(cell) + 1];
      const double per_m = (from_per_m + to_per_m) / 2;
      const double share = between_0_and_1((per_m - ends.low_per_m[i]) * ends.per_way_m[i]);
      put(cell, azimuths, part(share, per_m, whole_W * (from_per_m - to_per_m) * per_m * per_m),
          ranges);
      from_per_m = to_per_m;
    }
  }

  // An oblique wall: over its ranges alike, whatever the elevation, each at its own azimuths.
  [[gnu::always_inline]] void spread(double near_m, double far_m, int first, int last,
                                     LayerCells& ranges) const {
    const double per_m = 1.0 / (far_m - near_m), width = pieces.share[i];
    for (int cell = std::max(first, 0); cell <= std::min(last, grid.cells - 1); ++cell) {
      const double from_m = std::max(near_m, grid.minimum_m + grid.cell_m * cell);
      const double to_m = std::min(far_m, grid.minimum_m + grid.cell_m * (cell + 1));
      const double share = std::max(to_m - from_m, 0.0) * per_m;
      const double beside = pieces.right_nearer[i] != 0 ? far_m - to_m : from_m - near_m;
      put(cell, azimuths_in(pieces.left[i] + width * beside * per_m, width * share),
          part(0.5, ends.middle_per_m[i], powers.before_W_per_rad[i] * share), ranges);
    }
  }

  [[gnu::always_inline]] void add_rows(LayerCells& rows) const {
    const int first = ends.first_row[i], last = ends.last_row[i];
    if (last < first) return;
    if (ends.one_row[i] != 0) {
      const double per_m = ends.middle_per_m[i];
      if (per_m > grid.nearest_per_m || per_m <= grid.farthest_per_m) return;
      put(first, azimuths, middle().compensated(), rows);
      return;
    }
    const double high_row = powers.high_row[i], low_row = powers.low_row[i];
    const double whole_W = powers.before_W_per_rad[i];
    const double per_row_W_m2 = whole_W * ends.per_rows[i] * powers.range_m[i] * powers.range_m[i];
    for (int row = first; row <= last; ++row) {
      const double high = std::max(high_row, row + 0.0), low = std::min(low_row, row + 1.0);
      if (!(low > high)) continue;
      const double share = (low_row - (high + low) / 2) * ends.per_rows[i];
      const double per_m = ends.low_per_m[i] + share * ends.way_per_m[i];
      if (per_m > grid.nearest_per_m || per_m <= grid.farthest_per_m) continue;
      LayerEcho echo = part(share, per_m, per_row_W_m2 * (low - high) * per_m * per_m);
      echo.range_m = 1.0 / per_m;
      put(row, azimuths, echo.compensated(), rows);
    }
  }
};

FANBEAM_HOT(void, sort_in,
            (const LayerGrid& grid, const PowerTables& tables, const VisiblePieces& pieces,
             const PiecePowers& powers, LayerCells& ranges, LayerCells& rows),
            (grid, tables, pieces, powers, ranges, rows)) {
  PieceEnds ends;
  find_ends(grid, tables.nrcs(), pieces, powers, ends);
  find_cells(grid, pieces, powers, ends);
  const bool with_rows = rows.size() > 0;
  if (with_rows) find_rows(grid, powers, ends);
  for (int i = 0; i < pieces.count; ++i) {
    const PieceInCells piece{
        grid, pieces, powers, ends, azimuths_in(pieces.left[i], pieces.share[i]), i};
    piece.add_ranges(ranges);
    if (with_rows) piece.add_rows(rows);
  }
}

}  // namespace

LayerGrid::LayerGrid(const sensors::Sensor& sensor)
    : cells(sensor.range.cells),
      rows(sensor.display.cscope_rows),
      minimum_m(sensor.range.minimum_m),
      cell_m(sensor.range.cell_m),
      cells_per_m(1.0 / sensor.range.cell_m),
      nearest_per_m(minimum_m > 0.0 ? 1.0 / minimum_m : 1e300),
      farthest_per_m(1.0 / sensor.range.maximum_m()),
      top_rad(sensor.display.cscope_top_rad),
      rad_per_row(cscope_row_rad(sensor.display)) {
  // Tables hold what is beyond the pattern at its ends.
  constexpr double kInside_rad = 1e-6;  // more than floats round
  const double reach_rad = sensors::reach_rad(sensor.antenna.elevation) - kInside_rad;
  lowest_rad = sensor.antenna.boresight_elevation_rad - reach_rad;
  highest_rad = sensor.antenna.boresight_elevation_rad + reach_rad;
  for (int cell = 0; cell <= cells; ++cell) {
    const double border_m = minimum_m + cell_m * cell;
    border_per_m.push_back(border_m > 0.0 ? 1.0 / border_m : nearest_per_m);
  }
}

LayerSlices::LayerSlices(const SliceFrame& frame)
    : frame_(frame),
      grid_(frame.world.sensor),
      constant_W_m2_(frame.world.sensor.radar_constant_W_m2() *
                     azimuth_width_rad(frame.world.sensor)) {}

void LayerSlices::add(std::size_t i, LayerCells& ranges, LayerCells& rows) const {
  Buffers& buffers = buffers_of_thread();
  const Slice& slice = frame_.slices[i];
  // What an exception left behind must not show in another column.
  buffers.pieces.count = buffers.parts.count = 0;
  const auto sort = [&](VisiblePieces& pieces) { add(slice, pieces, ranges, rows); };
  const auto empty = [&](VisiblePieces& pieces) {
    fit_pieces(pieces, buffers.parts, sort);
    sort(pieces);
  };
  SliceSweep(frame_.world, frame_.antenna.position_m, frame_.edges, frame_.dark_below,
             buffers.scratch)
      .run(slice, frame_.edges.candidates(i / frame_.tile), frame_.world.sensor.range.maximum_m(),
           buffers.pieces, empty, {});
  empty(buffers.pieces);
  sort(buffers.parts);
}

void LayerSlices::add(const Slice& slice, VisiblePieces& pieces, LayerCells& ranges,
                      LayerCells& rows) const {
  PiecePowers& powers = buffers_of_thread().powers;
  const glm::dvec3& up = frame_.antenna.up;
  const SineWeights weights{slice.along.x * up.x + slice.along.y * up.y, up.z};
  measure_middles(pieces, powers);
  weigh(frame_.tables, frame_.tables.gain(), weights, constant_W_m2_, pieces, powers);
  if (!frame_.path_loss.clear())
    lose_on_path(frame_.path_loss, frame_.antenna.position_m.z, powers);
  place_in_rows(frame_.tables, weights, pieces, powers);
  sort_in(grid_, frame_.tables, pieces, powers, ranges, rows);
  pieces.count = 0;
}

}  // namespace fanbeam::renderer
