#include "renderer/plan/display_floor.h"

#include <algorithm>
#include <cmath>

#include "core/decibel.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

constexpr double kLargestDraw = 22.88;  // 33 ln 2: of one look

}  // namespace

double largest_change_dB(const AddedPower& added, const SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  const sensors::GreyScale scale(sensor);
  const double per_draw = facts.sample ? 1.0 / kLargestDraw : 1.0;
  const double noise_W = facts.noise_shown ? sensor.noise_power_W() : 0.0;
  double over_bscope = 0.0;
  double largest_W = 0.0;
  double all_cells_W_m3 = 0.0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double power_W = added.cell_W[static_cast<std::size_t>(row)];
    const double range_m = sensors::range_middle_m(sensor.range, row);
    over_bscope =
        std::max(over_bscope, power_W / std::max(scale.bscope_floor_W(row) * per_draw, noise_W));
    largest_W = std::max(largest_W, power_W);
    all_cells_W_m3 += power_W * range_m * range_m * range_m;
  }
  const double floor_W_m3 = scale.cscope_floor_W_m3() * per_draw;
  double over_cscope = 0.0;
  if (!facts.heights_shown) {
    // No C-scope is wanted.
  } else if (sensor.display.cscope_mode == sensors::Display::CScopeMode::true_elevation) {
    const double noise_W_m3 = facts.noise_shown ? sensors::cscope_noise_W_m3(sensor) : 0.0;
    over_cscope = added.row_W_m3 / std::max(floor_W_m3, noise_W_m3);
  } else {
    over_cscope = all_cells_W_m3 / floor_W_m3;
    if (noise_W > 0.0) over_cscope = std::min(over_cscope, largest_W / noise_W);
  }
  return std::min(scale.window_dB(),
                  core::kDecibelsPerNeper * std::log1p(std::max(over_bscope, over_cscope)));
}

double window_dB(const sensors::Sensor& sensor) { return sensors::GreyScale(sensor).window_dB(); }

}  // namespace fanbeam::renderer
