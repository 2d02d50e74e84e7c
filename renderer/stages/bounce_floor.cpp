#include "renderer/stages/bounce_floor.h"

#include <algorithm>

#include "core/parallel.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

// What shows in a range cell without any echo.
double dark_power_W(const sensors::Sensor& sensor, const sensors::GreyScale& scale, bool noise,
                    int cell) {
  return std::max(scale.bscope_floor_W(cell), noise ? sensor.noise_power_W() : 0.0);
}

// Power from a cell that stands out in the C-scope: rows below the horizon hold some hundred times
// what they hold without an echo.
double row_power_W(const sensors::Sensor& sensor, const sensors::GreyScale& scale, bool noise,
                   int cell) {
  constexpr double kHeld = 100.0;
  const double range_m = sensors::range_middle_m(sensor.range, cell);
  const double dark_W_m3 =
      std::max(scale.cscope_floor_W_m3(), noise ? sensors::cscope_noise_W_m3(sensor) : 0.0);
  return kHeld * dark_W_m3 / (range_m * range_m * range_m);
}

}  // namespace

BounceFloor::BounceFloor(const sensors::Sensor& sensor, bool noise, const FanSums& sums,
                         int sub_columns)
    : first_m_(sensor.range.minimum_m),
      cells_per_m_(1.0 / sensor.range.cell_m),
      cells_(sums.cells) {
  const auto cells = static_cast<std::size_t>(cells_);
  const auto strips = static_cast<std::size_t>((sums.sub_columns + sub_columns - 1) / sub_columns);
  std::vector<double> own_W(strips * cells, 0.0);
  const double beam_rad = sensors::two_way_width(sensor.antenna.azimuth);
  core::parallel_for(strips, [&](std::size_t strip) {
    const int first = static_cast<int>(strip) * sub_columns;
    const int end = std::min(first + sub_columns, sums.sub_columns);
    double* const own = &own_W[strip * cells];
    for (int sub = first; sub < end; ++sub) {
      const double* const power = &sums.range_W_per_rad[static_cast<std::size_t>(sub) * cells];
      for (std::size_t cell = 0; cell < cells; ++cell)
        own[cell] += power[cell] * beam_rad / (end - first);
    }
  });
  const sensors::GreyScale scale(sensor);
  power_W_.resize(own_W.size());
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double dark_W = dark_power_W(sensor, scale, noise, static_cast<int>(cell));
    const double row_W = row_power_W(sensor, scale, noise, static_cast<int>(cell));
    for (std::size_t strip = 0; strip < strips; ++strip) {
      const std::size_t left = strip > 0 ? strip - 1 : strip;
      const std::size_t right = strip + 1 < strips ? strip + 1 : strip;
      const double surfaces_W = (own_W[left * cells + cell] + 2.0 * own_W[strip * cells + cell] +
                                 own_W[right * cells + cell]) /
                                4.0;
      power_W_[strip * cells + cell] = std::min(dark_W + surfaces_W, row_W);
    }
  }
}

double BounceFloor::power_W(int strip, double range_m) const {
  const double cell = std::clamp((range_m - first_m_) * cells_per_m_, 0.0, cells_ - 1.0);
  return power_W_[static_cast<std::size_t>(strip) * static_cast<std::size_t>(cells_) +
                  static_cast<std::size_t>(cell)];
}

}  // namespace fanbeam::renderer
