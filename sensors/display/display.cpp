#include "sensors/display/display.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/errors.h"
#include "core/number_range.h"
#include "core/parallel.h"
#include "sensors/cells.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::sensors {
namespace {

void check_size(std::size_t found, int rows, int columns, const char* what) {
  const std::size_t expected = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  if (found != expected)
    throw core::InternalError(std::string(what) + " has " + std::to_string(found) +
                              " cells, expected " + std::to_string(expected));
}

double compensation_m3(const RangeGate& gate, int row) {
  const double range_m = range_middle_m(gate, row);
  return range_m * range_m * range_m;
}

// Calls work(row, begin, width) for every row of a picture, whose cells start at `begin`.
template <class Work>
void for_each_row(std::size_t cells, int columns, const Work& work) {
  const auto width = static_cast<std::size_t>(columns);
  core::parallel_for(cells / width, [&](std::size_t row) { work(row, row * width, width); });
}

// Share of the interval of elevations [low, high] that each C-scope row covers, called as add(row,
// share).
template <class Add>
void share_among_rows(const Display& display, double low_rad, double high_rad, const Add& add) {
  const double rows_per_rad = display.cscope_rows / display.cscope_span_rad;
  const double begin = (display.cscope_top_rad - high_rad) * rows_per_rad;
  const double end = (display.cscope_top_rad - low_rad) * rows_per_rad;
  const double rows = display.cscope_rows;
  if (!(end > 0.0 && begin < rows)) return;
  if (!(end > begin)) {  // thinner than double resolves
    add(static_cast<int>(begin), 1.0);
    return;
  }
  const int first = static_cast<int>(std::max(begin, 0.0));
  const int last = static_cast<int>(std::min(std::ceil(end), rows)) - 1;
  for (int row = first; row <= last; ++row) {
    const double covered = std::min(end, row + 1.0) - std::max(begin, static_cast<double>(row));
    if (covered > 0.0) add(row, covered / (end - begin));
  }
}

}  // namespace

std::vector<double> bscope_grey(const Sensor& sensor, std::span<const double> power_W) {
  check_size(power_W.size(), sensor.range.cells, sensor.scan.columns, "B-scope power");
  const GreyScale scale(sensor);
  std::vector<double> grey(power_W.size());
  for_each_row(grey.size(), sensor.scan.columns,
               [&](std::size_t row, std::size_t begin, std::size_t width) {
                 scale.bscope_grey(power_W.subspan(begin, width), static_cast<int>(row),
                                   grey.data() + begin);
               });
  return grey;
}

std::vector<double> cscope_grey(const Sensor& sensor, std::span<const double> compensated_W_m3) {
  check_size(compensated_W_m3.size(), sensor.display.cscope_rows, sensor.scan.columns,
             "C-scope power");
  const GreyScale scale(sensor);
  std::vector<double> grey(compensated_W_m3.size());
  for_each_row(grey.size(), sensor.scan.columns,
               [&](std::size_t, std::size_t begin, std::size_t width) {
                 scale.cscope_grey(compensated_W_m3.subspan(begin, width), grey.data() + begin);
               });
  return grey;
}

Picture8 bscope_picture(const Sensor& sensor, std::span<const double> grey) {
  check_size(grey.size(), sensor.range.cells, sensor.scan.columns, "B-scope grey");
  Picture8 picture{sensor.scan.columns, sensor.range.cells, {}};
  picture.pixels.resize(grey.size());
  const auto width = static_cast<std::size_t>(picture.columns);
  std::uint8_t* row = picture.pixels.data();
  for (std::size_t begin = grey.size(); begin > 0; begin -= width, row += width)
    round_greys(grey.subspan(begin - width, width), row);
  return picture;
}

Picture8 cscope_picture(const Sensor& sensor, std::span<const double> grey) {
  check_size(grey.size(), sensor.display.cscope_rows, sensor.scan.columns, "C-scope grey");
  Picture8 picture{sensor.scan.columns, sensor.display.cscope_rows, {}};
  picture.pixels.resize(grey.size());
  round_greys(grey, picture.pixels.data());
  return picture;
}

std::vector<double> flat_earth_cscope_W_m3(const Sensor& sensor, std::span<const double> power_W,
                                           double height_m) {
  check_size(power_W.size(), sensor.range.cells, sensor.scan.columns, "B-scope power");
  core::require_range("height above ground", height_m, {.low = 0.0, .above_low = true}, "m");

  const auto width = static_cast<std::size_t>(sensor.scan.columns);
  std::vector<double> compensated_W_m3(static_cast<std::size_t>(sensor.display.cscope_rows) * width,
                                       0.0);
  const auto ground_elevation_rad = [&](double range_m) {
    return range_m > height_m ? -std::asin(height_m / range_m) : -core::kPi / 2;
  };
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double* const echoes_W = power_W.data() + static_cast<std::size_t>(row) * width;
    const double factor_m3 = compensation_m3(sensor.range, row);
    share_among_rows(sensor.display, ground_elevation_rad(range_edge_m(sensor.range, row)),
                     ground_elevation_rad(range_edge_m(sensor.range, row + 1)),
                     [&](int cscope_row, double share) {
                       double* const pixels =
                           compensated_W_m3.data() + static_cast<std::size_t>(cscope_row) * width;
                       for (std::size_t column = 0; column < width; ++column)
                         pixels[column] += echoes_W[column] * factor_m3 * share;
                     });
  }
  return compensated_W_m3;
}

double cscope_noise_W_m3(const Sensor& sensor) {
  return sensor.noise_power_W() * compensated_cells_m3(sensor.range) / sensor.display.cscope_rows;
}

}  // namespace fanbeam::sensors
