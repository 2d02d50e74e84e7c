#include "sensors/shadow/shadow_certainty.h"

#include <algorithm>
#include <cmath>

#include "sensors/cells.h"

namespace fanbeam::sensors {
namespace {

constexpr double kLeastCells = 6.0;
constexpr double kSameGround = 2.0;  // ratio of levels
constexpr double kBrightestBefore = 1.4;
constexpr double kAllowedError_m = 1.0;
constexpr double kPartRoof = 0.25;  // of a cell

bool stands_on_ground(const ShadowColumns& columns) {
  const double before = median_of(columns, [](const ShadowRun& run) { return run.before; });
  return before > 1.0 / kSameGround && before < kBrightestBefore;
}

bool ends_on_the_same_ground(const ShadowColumns& columns) {
  const double before = median_of(columns, [](const ShadowRun& run) { return run.before; });
  const double behind = median_of(columns, [](const ShadowRun& run) { return run.behind; });
  const double least = median_of(columns, [](const ShadowRun& run) { return run.behind_least; });
  const double most = median_of(columns, [](const ShadowRun& run) { return run.behind_most; });
  return behind < kSameGround * before && before < kSameGround * behind &&
         most < kSameGround * behind && behind < kSameGround * least;
}

bool columns_agree(const RangeGate& gate, const ShadowColumns& columns, double height_m) {
  const auto column_height_m = [&](const ShadowRun& run) {
    return shadow_height_m(gate, run, height_m);
  };
  const double middle_m = median_of(columns, column_height_m);
  const double deviation_m = median_of(
      columns, [&](const ShadowRun& run) { return std::abs(column_height_m(run) - middle_m); });
  const double cell_worth_m = median_of(columns, [&](const ShadowRun& run) {
    const double end_m = end_range_m(gate, run);
    return height_m * top_range_m(gate, run) * gate.cell_m / (end_m * end_m);
  });
  return deviation_m <= 0.5 * std::max(kAllowedError_m, cell_worth_m);
}

}  // namespace

double top_range_m(const RangeGate& gate, const ShadowRun& run) {
  if (run.roof_rows > 0) return range_middle_m(gate, run.start_row + run.roof_rows - 1);
  if (run.start_row == run.edge_row + 1 && run.start_offset < kPartRoof)
    return range_middle_m(gate, run.edge_row);
  return range_edge_m(gate, run.start_row) + run.start_offset * gate.cell_m;
}

double end_range_m(const RangeGate& gate, const ShadowRun& run) {
  return range_edge_m(gate, run.end_row) + run.end_offset * gate.cell_m;
}

double shadow_height_m(const RangeGate& gate, const ShadowRun& run, double height_m) {
  return height_m * (1.0 - top_range_m(gate, run) / end_range_m(gate, run));
}

bool tells_height(const RangeGate& gate, const ShadowColumns& columns, double height_m) {
  if (std::any_of(columns.begin(), columns.end(),
                  [](const ShadowRun& run) { return run.truncated; }))
    return false;
  const double length_m = median_of(columns, [&](const ShadowRun& run) {
    return end_range_m(gate, run) - top_range_m(gate, run);
  });
  return length_m >= kLeastCells * gate.cell_m && stands_on_ground(columns) &&
         ends_on_the_same_ground(columns) && columns_agree(gate, columns, height_m);
}

}  // namespace fanbeam::sensors
