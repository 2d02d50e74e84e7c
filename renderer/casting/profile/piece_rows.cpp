// Where pieces fall in the rows of the C-scope.
#include <cmath>

#include "core/dispatch.h"
#include "renderer/casting/profile/piece_loops.h"
#include "renderer/casting/profile/piece_powers.h"

namespace fanbeam::renderer {
namespace {

// Sines to which arc_sine is good to 2e-8 rad.
constexpr double kNearHorizon = 0.4;

inline double arc_sine(double x) {
  const double y = x * x;
  return x * (1.0 + y * (1.0 / 6 +
                         y * (3.0 / 40 + y * (15.0 / 336 +
                                              y * (105.0 / 3456 + y * (945.0 / 42240 +
                                                                       y * (10395.0 / 599040)))))));
}

// `row_of` tells the row of a sine of the elevation.
template <class RowOf>
inline void place(const RowOf& row_of, const SineWeights& weights, const VisiblePieces& pieces,
                  PiecePowers& powers) {
  const In near_distance_m = pieces.near_distance_m.data();
  const In near_height_m = pieces.near_height_m.data();
  const In far_distance_m = pieces.far_distance_m.data();
  const In far_height_m = pieces.far_height_m.data();
  const In near_range_m = powers.near_range_m.data(), far_range_m = powers.far_range_m.data();
  const Out high_row = powers.high_row.data(), low_row = powers.low_row.data();
  const double along = weights.along, up = weights.up;
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double near_row =
        row_of((along * near_distance_m[i] + up * near_height_m[i]) / near_range_m[i]);
    const double far_row =
        row_of((along * far_distance_m[i] + up * far_height_m[i]) / far_range_m[i]);
    high_row[i] = near_row < far_row ? near_row : far_row;
    low_row[i] = near_row < far_row ? far_row : near_row;
  }
}

FANBEAM_HOT(void, place_anywhere,
            (const PowerTables& tables, const SineWeights& weights, const VisiblePieces& pieces,
             PiecePowers& powers),
            (tables, weights, pieces, powers)) {
  const In row = tables.row();
  const double lowest_sine = tables.lowest_sine(), per_sine = tables.steps_per_sine();
  constexpr double kLastStep = PowerTables::kSineSteps;
  const auto row_of = [=](double sine) {
    const double at = (sine - lowest_sine) * per_sine;
    const double above = at > 0.0 ? at : 0.0;
    const double position = above < kLastStep ? above : kLastStep;
    const int step = static_cast<int>(position);
    return row[step] + (position - step) * (row[step + 1] - row[step]);
  };
  place(row_of, weights, pieces, powers);
}

// Near the horizon the arc sine is a short series: no table is needed.
FANBEAM_HOT(void, place_near_horizon,
            (const PowerTables& tables, const SineWeights& weights, const VisiblePieces& pieces,
             PiecePowers& powers),
            (tables, weights, pieces, powers)) {
  const double top_rad = tables.top_rad(), per_rad = tables.rows_per_rad();
  const auto row_of = [=](double sine) {
    const double not_high = sine < kNearHorizon ? sine : kNearHorizon;
    return (top_rad - arc_sine(not_high > -kNearHorizon ? not_high : -kNearHorizon)) * per_rad;
  };
  place(row_of, weights, pieces, powers);
}

}  // namespace

void place_in_rows(const PowerTables& tables, const SineWeights& weights,
                   const VisiblePieces& pieces, PiecePowers& powers) {
  if (tables.near_horizon(kNearHorizon))
    place_near_horizon(tables, weights, pieces, powers);
  else
    place_anywhere(tables, weights, pieces, powers);
}

FANBEAM_HOT(void, share_rows, (int rows_in_picture, int cells_in_gate, PiecePowers& powers),
            (rows_in_picture, cells_in_gate, powers)) {
  const In high_row = powers.high_row.data(), low_row = powers.low_row.data();
  const In before = powers.before_W_per_rad.data(), behind = powers.behind_W_per_rad.data();
  const In range_m = powers.range_m.data();
  const std::int32_t* before_cell = powers.before_cell.data();
  std::int32_t* kind = powers.kind.data();
  std::int32_t* row = powers.row.data();
  const Out row_share = powers.row_share.data(), row_W_m3 = powers.row_W_m3_per_rad.data();
  const double rows = rows_in_picture, cells = cells_in_gate;
  constexpr double kManyRows = PiecePowers::many_rows;
  const int count = powers.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double from = high_row[i], to = low_row[i];
    const double first = std::floor(from), last = std::floor(to);
    const double width = to - from;
    const double share = last > first ? (last - from) / (width > 0.0 ? width : 1.0) : 1.0;
    const double seen = before_cell[i] < cells ? 1.0 : 0.0;
    const double power_W_per_rad = (before[i] + behind[i]) * seen;
    // 0 where two rows of the picture hold it all.
    const double odd =
        (last - first > 1.0 ? 1.0 : 0.0) + (first < 0.0 ? 1.0 : 0.0) + (last >= rows ? 1.0 : 0.0);
    kind[i] += static_cast<std::int32_t>(odd * seen > 0.0 ? kManyRows : 0.0);
    const double plain = odd > 0.0 ? 0.0 : seen;
    row[i] = static_cast<std::int32_t>(plain > 0.0 ? first + 1.0 : 0.0);
    row_share[i] = share;
    row_W_m3[i] = plain * power_W_per_rad * range_m[i] * range_m[i] * range_m[i];
  }
}

}  // namespace fanbeam::renderer
