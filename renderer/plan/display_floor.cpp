#include "renderer/plan/display_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decibel.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

constexpr double kLargestDraw = 22.88;  // 33 ln 2: of one look

// What is added over what is there; beside nothing at all whatever is added counts.
double times_over(double added, double present) {
  if (!(added > 0.0)) return 0.0;
  return present > 0.0 ? added / present : std::numeric_limits<double>::infinity();
}

// The largest added power over what a row of the C-scope shows without it.
double over_cscope(const AddedPower& added, const SceneFacts& facts, double floor_W_m3) {
  const sensors::Sensor& sensor = facts.sensor;
  if (sensor.display.cscope_mode == sensors::Display::CScopeMode::true_elevation) {
    const double noise_W_m3 = facts.noise_shown ? sensors::cscope_noise_W_m3(sensor) : 0.0;
    return times_over(added.row_W_m3, std::max(floor_W_m3, noise_W_m3));
  }
  double largest_W = 0.0;
  double all_cells_W_m3 = 0.0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double power_W = added.cell_W[static_cast<std::size_t>(row)];
    const double range_m = sensors::range_middle_m(sensor.range, row);
    largest_W = std::max(largest_W, power_W);
    all_cells_W_m3 += power_W * range_m * range_m * range_m;
  }
  const double over_floor = times_over(all_cells_W_m3, floor_W_m3);
  const double noise_W = facts.noise_shown ? sensor.noise_power_W() : 0.0;
  return noise_W > 0.0 ? std::min(over_floor, largest_W / noise_W) : over_floor;
}

}  // namespace

double largest_change_dB(const AddedPower& added, const SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  const sensors::GreyScale scale(sensor);
  // Of the display's black; watts end at none.
  const double share = facts.read.watts() ? 0.0 : facts.sample ? 1.0 / kLargestDraw : 1.0;
  const double noise_W = facts.noise_shown ? sensor.noise_power_W() : 0.0;
  double most =
      facts.heights_shown ? over_cscope(added, facts, scale.cscope_floor_W_m3() * share) : 0.0;
  for (int row = 0; row < sensor.range.cells; ++row)
    most = std::max(most, times_over(added.cell_W[static_cast<std::size_t>(row)],
                                     std::max(scale.bscope_floor_W(row) * share, noise_W)));
  return std::min(scale.window_dB(), core::kDecibelsPerNeper * std::log1p(most));
}

double window_dB(const sensors::Sensor& sensor) { return sensors::GreyScale(sensor).window_dB(); }

}  // namespace fanbeam::renderer
