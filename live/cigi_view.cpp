#include "live/cigi_view.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace fanbeam::live {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Interval {
  double from = -kInfinite, to = kInfinite;
  bool holds(double value) const { return from <= value && value <= to; }
};

// `first` is the bit of the lower bound, `second` that of the upper one.
Interval interval(std::uint8_t enables, unsigned first, double from, unsigned second, double to) {
  return {(enables >> first & 1U) != 0 ? from : -kInfinite,
          (enables >> second & 1U) != 0 ? to : kInfinite};
}

// Row by row, from the one of index 0 on; `wanted` tells whether a cell stays.
template <class Wanted>
void blank(core::Picture8& picture, const Wanted& wanted) {
  std::size_t at = 0;
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.columns; ++column, ++at)
      if (!wanted(row, column)) picture.pixels[at] = 0;
}

void turn_around(core::Picture8& picture) {
  for (std::uint8_t& grey : picture.pixels) grey = static_cast<std::uint8_t>(255 - grey);
}

}  // namespace

void show(const CigiView& view, const sensors::Sensor& sensor, LiveFrame& frame) {
  const feeds::cigi::ViewDefinition& window = view.window;
  const Interval ranges = interval(window.enables, 0, window.near_m, 1, window.far_m),
                 azimuths = interval(window.enables, 2, window.left_rad, 3, window.right_rad),
                 elevations = interval(window.enables, 5, window.bottom_rad, 4, window.top_rad);
  const auto column_wanted = [&](int column) {
    return view.on && azimuths.holds((column + 0.5) * sensor.scan.column_width_rad() -
                                     sensor.scan.field_of_view_rad / 2);
  };
  const auto range_wanted = [&](int cell) {
    return ranges.holds(sensor.range.minimum_m + (cell + 0.5) * sensor.range.cell_m);
  };
  if (view.black_hot) {
    turn_around(frame.bscope);
    turn_around(frame.cscope);
    std::swap(frame.low_dB, frame.high_dB);
  }
  if (view.on && window.enables == 0) return;
  blank(frame.bscope, [&](int row, int column) {
    return column_wanted(column) && range_wanted(sensor.range.cells - 1 - row);
  });
  const double row_rad = sensor.display.cscope_span_rad / sensor.display.cscope_rows;
  blank(frame.cscope, [&](int row, int column) {
    return column_wanted(column) &&
           elevations.holds(sensor.display.cscope_top_rad - (row + 0.5) * row_rad);
  });
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  for (std::size_t at = 0; at < frame.received_W.size(); ++at)
    if (!column_wanted(static_cast<int>(at % columns)) ||
        !range_wanted(static_cast<int>(at / columns)))
      frame.received_W[at] = 0.0;
}

}  // namespace fanbeam::live
