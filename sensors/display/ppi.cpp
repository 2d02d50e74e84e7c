#include "sensors/display/ppi.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/number_range.h"
#include "core/parallel.h"
#include "core/units.h"
#include "sensors/cells.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::sensors {
namespace {

constexpr int kMostPixels = 8192;  // along one side

void check_side(const char* field, int size_px) {
  core::require_range(field, size_px, {1.0, kMostPixels}, "pixels");
}

void check(const PpiView& view, double heading_rad) {
  check_side("ppi.columns", view.columns);
  check_side("ppi.rows", view.rows);
  core::require_range("ppi.metres_per_pixel", view.metres_per_pixel,
                      {.low = 0.0, .above_low = true});
  core::require_range("ppi.antenna_column", view.antenna_column, {});
  core::require_range("ppi.antenna_row", view.antenna_row, {});
  core::require_range("heading", heading_rad, {});
}

// Of the cell at any range and azimuth; 0 outside.
double grey_at(const Sensor& sensor, std::span<const double> grey, double range_m,
               double azimuth_rad) {
  const int row = range_row(sensor.range, range_m);
  const int column = azimuth_column(sensor.scan, azimuth_rad);
  if (row == kOutside || column == kOutside) return 0.0;
  return grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(sensor.scan.columns) +
              static_cast<std::size_t>(column)];
}

// Whole pixels of `size_px` that lie beyond `needed_px`; an even number, so that a picture of even
// size stays one, as films ask for.
int spare_px(double size_px, double needed_px) {
  constexpr double kRounding_px = 1e-6;
  return 2 * static_cast<int>(std::max(0.0, size_px - needed_px + kRounding_px) / 2.0);
}

PpiView track_up(double range_m, double half_sector_rad, int size_px) {
  const bool ahead_only = half_sector_rad <= core::kPi / 2;
  const double half_width = ahead_only ? std::sin(half_sector_rad) : 1.0;  // of the range
  const double behind = ahead_only ? 0.0 : -std::cos(half_sector_rad);
  PpiView view;
  view.up = PpiView::Up::track;
  view.metres_per_pixel = 2.0 * std::max(0.5, half_width) * range_m / size_px;
  const double range_px = range_m / view.metres_per_pixel;
  view.columns = size_px - spare_px(size_px, 2.0 * half_width * range_px);
  view.rows = size_px - spare_px(size_px, (1.0 + behind) * range_px);
  view.antenna_column = 0.5 * view.columns;
  view.antenna_row = ahead_only ? view.rows : 0.5 * size_px;
  return view;
}

PpiView north_up(double range_m, double half_sector_rad, int size_px, double heading_rad) {
  // Circle through the antenna and the two far corners, then over the chord between these.
  double radius = 1.0, ahead = 0.0;  // of the range
  if (half_sector_rad <= core::kPi / 4) {
    radius = ahead = 0.5 / std::cos(half_sector_rad);
  } else if (half_sector_rad <= core::kPi / 2) {
    radius = std::sin(half_sector_rad);
    ahead = std::cos(half_sector_rad);
  }
  PpiView view;
  view.up = PpiView::Up::north;
  view.columns = size_px;
  view.rows = size_px;
  view.metres_per_pixel = 2.0 * radius * range_m / size_px;
  const double ahead_px = ahead * range_m / view.metres_per_pixel;
  view.antenna_column = 0.5 * size_px - ahead_px * std::sin(heading_rad);
  view.antenna_row = 0.5 * size_px + ahead_px * std::cos(heading_rad);
  return view;
}

}  // namespace

PpiView ppi_view(const Sensor& sensor, PpiView::Up up, int size_px, double heading_rad) {
  check_side("ppi size", size_px);
  core::require_range("heading", heading_rad, {});
  const double half_sector_rad = 0.5 * sensor.scan.field_of_view_rad;
  return up == PpiView::Up::track
             ? track_up(sensor.range.maximum_m(), half_sector_rad, size_px)
             : north_up(sensor.range.maximum_m(), half_sector_rad, size_px, heading_rad);
}

std::vector<double> ppi_grey(const Sensor& sensor, std::span<const double> bscope_grey,
                             double heading_rad, const PpiView& view) {
  check(view, heading_rad);
  const auto cells =
      static_cast<std::size_t>(sensor.range.cells) * static_cast<std::size_t>(sensor.scan.columns);
  if (bscope_grey.size() != cells)
    throw core::InternalError("the B-scope grey does not have the size of the sensor's B-scope");
  const double turn_rad = view.up == PpiView::Up::north ? heading_rad : 0.0;
  const auto width = static_cast<std::size_t>(view.columns);
  std::vector<double> grey(static_cast<std::size_t>(view.rows) * width);
  core::parallel_for(static_cast<std::size_t>(view.rows), [&](std::size_t row) {
    const double up_m =
        (view.antenna_row - (static_cast<double>(row) + 0.5)) * view.metres_per_pixel;
    for (std::size_t column = 0; column < width; ++column) {
      const double right_m =
          (static_cast<double>(column) + 0.5 - view.antenna_column) * view.metres_per_pixel;
      const double range_m = std::hypot(right_m, up_m);
      const double azimuth_rad = core::wrap_pi_rad(std::atan2(right_m, up_m) - turn_rad);
      grey[row * width + column] = grey_at(sensor, bscope_grey, range_m, azimuth_rad);
    }
  });
  return grey;
}

Picture8 ppi_picture(const PpiView& view, std::span<const double> grey) {
  Picture8 picture{view.columns, view.rows, std::vector<std::uint8_t>(grey.size())};
  std::transform(grey.begin(), grey.end(), picture.pixels.begin(), grey8);
  return picture;
}

}  // namespace fanbeam::sensors
