#include "sensors/shadow/shadow_obstacles.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.h"
#include "core/median.h"
#include "core/number_range.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/shadow/shadow_certainty.h"
#include "sensors/shadow/shadow_runs.h"

namespace fanbeam::sensors {
namespace {

constexpr int kStartStep = 4;  // rows between the starts of neighbouring columns
constexpr int kBorder = 2;     // columns at the picture's sides
constexpr int kSkirt = 4;      // columns beside a shadow that its smeared sides may reach
constexpr double kLeastDepth = 0.35;
constexpr double kLeastEdge = 2.0, kLeastFront = 1.5;
constexpr double kFillTolerance = 0.15;  // shallow shadows: sides of any shape
constexpr double kDeepFill = 0.02;
constexpr double kLongShadow = 0.9;  // ratio of its quarters' ranges: below it sides can be told
constexpr double kLeastHeight_m = 3.0;

using Group = ShadowColumns;

bool same_obstacle(const ShadowRun& a, const ShadowRun& b) {
  const int common = std::min(a.end_row, b.end_row) - std::max(a.start_row, b.start_row);
  const int shorter = std::min(a.end_row - a.start_row, b.end_row - b.start_row);
  return std::abs(a.start_row - b.start_row) <= kStartStep && 2 * common >= shorter;
}

std::vector<Group> groups_of(const std::vector<ShadowRun>& runs) {
  std::vector<Group> groups;
  for (const ShadowRun& run : runs) {
    Group* home = nullptr;
    for (Group& group : groups)
      if (group.back().column == run.column - 1 && same_obstacle(group.back(), run) &&
          (home == nullptr || home->back().score < group.back().score))
        home = &group;
    if (home == nullptr)
      groups.push_back({run});
    else
      home->push_back(run);
  }
  return groups;
}

// Without the columns that the beam's edge alone darkens.
Group core_of(const Group& group) {
  double deepest = 0.0;
  for (const ShadowRun& run : group) deepest = std::max(deepest, run.depth());
  Group core;
  if (deepest < kLeastDepth) return core;
  for (const ShadowRun& run : group)
    if (run.depth() >= 0.5 * deepest) core.push_back(run);
  return core;
}

// A cut through a shadow, over some of its rows.
struct Cut {
  double columns = 0.0;  // width: the beam smears a shadow but keeps its area
  double floor = 1.0;    // of the darkest column, as a share of the lit ground
};

Cut cut_through(const ShadowGround& ground, const Group& core, double from, double to) {
  const double start = median_of(core, [](const ShadowRun& run) { return run.start_row; });
  const double length = median_of(core, [](const ShadowRun& run) { return run.end_row; }) - start;
  const double lit = median_of(core, [](const ShadowRun& run) { return run.lit; });
  const int first = static_cast<int>(start + from * length);
  const int last = std::max(static_cast<int>(start + to * length), first + 1);
  const auto share = [&](int column) {
    std::vector<double> values;
    for (int row = first; row < last; ++row) values.push_back(ground.at(row, column));
    return std::clamp(core::median(std::move(values)) / lit, 0.0, 1.0);
  };
  Cut cut;
  const int left = core.front().column, right = core.back().column;
  for (int column = left; column <= right; ++column) {
    cut.floor = std::min(cut.floor, share(column));
    cut.columns += 1.0 - share(column);
  }
  const auto add_skirt = [&](int column, int step) {
    for (int k = 0; k < kSkirt && column >= 0 && column < ground.columns; ++k, column += step) {
      if (share(column) > 0.9) return;
      cut.columns += 1.0 - share(column);
    }
  };
  add_skirt(left - 1, -1);
  add_skirt(right + 1, 1);
  return cut;
}

bool stands_out(const ShadowGround& ground, const Group& core) {
  const double speckle = 4.0 * ground.fluctuation;
  const double edge = median_of(core, [](const ShadowRun& run) { return run.edge / run.lit; });
  const double front =
      median_of(core, [](const ShadowRun& run) { return run.edge / std::max(run.before, 0.05); });
  return edge >= kLeastEdge + speckle && front >= kLeastFront + speckle;
}

// As dark and as straight as a shadow of its width, not as dark ground is.
bool is_shadow(const Sensor& sensor, const ShadowGround& ground, const Group& core) {
  const Cut near = cut_through(ground, core, 0.1, 0.4);
  const Cut far = cut_through(ground, core, 0.6, 0.9);
  const double width_rad = 0.5 * (near.columns + far.columns) * sensor.scan.column_width_rad();
  const BeamCut& beam = sensor.antenna.azimuth;
  const double fill =
      1.0 - two_way_integral(beam, -0.5 * width_rad, 0.5 * width_rad) / two_way_width(beam);
  if (std::max(near.floor, far.floor) > fill + kFillTolerance) return false;
  if (fill < kDeepFill && std::min(near.floor, far.floor) > kDeepFill) return false;
  const double start = median_of(core, [](const ShadowRun& run) { return run.start_row; });
  const double length = median_of(core, [](const ShadowRun& run) { return run.end_row; }) - start;
  const auto range_m = [&](double share) {
    return sensor.range.minimum_m + (start + share * length) * sensor.range.cell_m;
  };
  const double strip = range_m(0.25) / range_m(0.75);
  return strip > kLongShadow || far.columns >= 0.5 * (1.0 + strip) * near.columns;
}

ShadowObstacle obstacle_of(const Sensor& sensor, const Group& core, double height_m) {
  const RangeGate& gate = sensor.range;
  ShadowObstacle obstacle;
  obstacle.first_column = core.front().column;
  obstacle.last_column = core.back().column;
  Group free, cut;
  std::size_t merged = 0;
  double weight = 0.0;
  for (const ShadowRun& run : core) {
    (run.truncated ? cut : free).push_back(run);
    merged += run.merged ? 1 : 0;
    obstacle.azimuth_rad += run.depth() * column_middle_rad(sensor.scan, run.column);
    weight += run.depth();
    // A column left out within the obstacle takes its right neighbour's range.
    while (obstacle.first_column + static_cast<int>(obstacle.column_range_m.size()) <= run.column)
      obstacle.column_range_m.push_back(range_middle_m(gate, run.edge_row));
  }
  obstacle.azimuth_rad /= weight;
  obstacle.truncated = 3 * free.size() < core.size();
  obstacle.merged = 3 * merged >= core.size();
  const Group& whole = obstacle.truncated ? cut : free;
  const double top_m =
      median_of(whole, [&](const ShadowRun& run) { return top_range_m(gate, run); });
  obstacle.range_m =
      median_of(core, [&](const ShadowRun& run) { return range_middle_m(gate, run.edge_row); });
  obstacle.height_m =
      median_of(whole, [&](const ShadowRun& run) { return shadow_height_m(gate, run, height_m); });
  // L from the height, so that the figures of one obstacle agree.
  const double end_m = top_m / (1.0 - obstacle.height_m / height_m);
  obstacle.shadow_length_m = end_m - top_m;
  obstacle.height_error_m = height_m * top_m * gate.cell_m / (end_m * end_m);
  return obstacle;
}

void check(const Sensor& sensor, std::size_t cells, double height_m) {
  const std::size_t expected =
      static_cast<std::size_t>(sensor.range.cells) * static_cast<std::size_t>(sensor.scan.columns);
  if (cells != expected)
    throw core::InternalError("B-scope power has " + std::to_string(cells) + " cells, expected " +
                              std::to_string(expected));
  core::require_range("height above ground", height_m, {.low = 0.0, .above_low = true}, "m");
}

}  // namespace

std::vector<ShadowObstacle> shadow_obstacles(const Sensor& sensor, std::span<const double> power_W,
                                             double height_m) {
  check(sensor, power_W.size(), height_m);
  const ShadowGround ground = shadow_ground(sensor, power_W);
  std::vector<ShadowObstacle> obstacles;
  for (const Group& group : groups_of(shadow_runs(ground))) {
    const Group core = core_of(group);
    if (core.size() < 2 || core.front().column < kBorder ||
        core.back().column >= sensor.scan.columns - kBorder)
      continue;
    if (!stands_out(ground, core) || !is_shadow(sensor, ground, core)) continue;
    ShadowObstacle obstacle = obstacle_of(sensor, core, height_m);
    obstacle.uncertain = obstacle.merged || !tells_height(sensor.range, core, height_m);
    if (obstacle.height_m >= kLeastHeight_m) obstacles.push_back(obstacle);
  }
  return obstacles;
}

}  // namespace fanbeam::sensors
