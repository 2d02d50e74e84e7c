#include "sensors/shadow/shadow_cscope.h"

#include <algorithm>
#include <cmath>

#include "sensors/cells.h"
#include "sensors/display/display.h"

namespace fanbeam::sensors {
namespace {

constexpr int kEdgeRows = 3;

// P R^3 of the leading edge.
double face_W_m3(const Sensor& sensor, std::span<const double> power_W, int column,
                 double range_m) {
  const int middle = range_row(sensor.range, range_m);
  const int last = std::min(middle + kEdgeRows, sensor.range.cells - 1);
  double brightest_W_m3 = 0.0;
  for (int row = std::max(middle - kEdgeRows, 0); row <= last; ++row) {
    const double row_m = range_middle_m(sensor.range, row);
    const double echo_W = power_W[static_cast<std::size_t>(row * sensor.scan.columns + column)];
    brightest_W_m3 = std::max(brightest_W_m3, echo_W * row_m * row_m * row_m);
  }
  return brightest_W_m3;
}

// Elevation of a point `height_m` above (below: negative) the antenna at a slant range.
double elevation_rad(double height_m, double range_m) {
  return std::asin(std::clamp(height_m / range_m, -1.0, 1.0));
}

}  // namespace

std::vector<double> shadow_cscope_W_m3(const Sensor& sensor, std::span<const double> power_W,
                                       double height_m,
                                       const std::vector<ShadowObstacle>& obstacles) {
  std::vector<double> cscope_W_m3 = flat_earth_cscope_W_m3(sensor, power_W, height_m);
  const Display& display = sensor.display;
  const double rows_per_rad = display.cscope_rows / display.cscope_span_rad;
  std::vector<const ShadowObstacle*> order;
  for (const ShadowObstacle& obstacle : obstacles)
    if (!obstacle.uncertain) order.push_back(&obstacle);
  std::stable_sort(
      order.begin(), order.end(),
      [](const ShadowObstacle* a, const ShadowObstacle* b) { return a->range_m > b->range_m; });
  for (const ShadowObstacle* obstacle : order)
    for (int column = obstacle->first_column; column <= obstacle->last_column; ++column) {
      const double range_m =
          obstacle->column_range_m[static_cast<std::size_t>(column - obstacle->first_column)];
      // As many cells as a row of flat ground holds there.
      const double cells_per_row =
          range_m * range_m / (height_m * sensor.range.cell_m * rows_per_rad);
      const double face = cells_per_row * face_W_m3(sensor, power_W, column, range_m);
      const auto row_of = [&](double above_ground_m) {
        const double depth_rad =
            display.cscope_top_rad - elevation_rad(above_ground_m - height_m, range_m);
        return static_cast<int>(std::clamp(std::floor(depth_rad * rows_per_rad), -1.0,
                                           static_cast<double>(display.cscope_rows)));
      };
      const int foot = std::min(row_of(0.0), display.cscope_rows - 1);
      for (int row = std::max(row_of(obstacle->height_m), 0); row <= foot; ++row)
        cscope_W_m3[static_cast<std::size_t>(row * sensor.scan.columns + column)] = face;
    }
  return cscope_W_m3;
}

}  // namespace fanbeam::sensors
