#include "renderer/plan/display_floor.h"

#include <algorithm>
#include <cmath>

#include "sensors/cells.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

constexpr double kDecibelsPerNeper = 4.342944819032518;  // of power: 10 / ln 10
constexpr double kLargestDraw = 22.88;                   // 33 ln 2: of one look

}  // namespace

double largest_change_dB(const AddedPower& added, const SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  const sensors::GreyScale scale(sensor);
  double most = 0.0;
  double all_cells_W_m3 = 0.0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double power_W = added.cell_W[static_cast<std::size_t>(row)];
    const double range_m = sensors::range_middle_m(sensor.range, row);
    most = std::max(most, power_W / scale.bscope_floor_W(row));
    all_cells_W_m3 += power_W * range_m * range_m * range_m;
  }
  const bool resolved = sensor.display.cscope_mode == sensors::Display::CScopeMode::true_elevation;
  const double cscope_W_m3 = resolved ? added.row_W_m3 : all_cells_W_m3;
  most = std::max(most, cscope_W_m3 / scale.cscope_floor_W_m3());
  if (facts.sample) most *= kLargestDraw;
  return std::min(scale.window_dB(), kDecibelsPerNeper * std::log1p(most));
}

double window_dB(const sensors::Sensor& sensor) { return sensors::GreyScale(sensor).window_dB(); }

}  // namespace fanbeam::renderer
