#include "sensors/display/ppi.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "core/units.h"
#include "sensors/cells.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::radians;
using Up = PpiView::Up;

namespace {

std::vector<double> bscope(double value) { return std::vector<double>(524 * 164, value); }

// Range and bearing of the brightest pixel's middle.
struct Polar {
  double range_m = 0.0;
  double bearing_deg = 0.0;
};
Polar brightest(const PpiView& view, const std::vector<double>& grey) {
  const auto i = std::max_element(grey.begin(), grey.end()) - grey.begin();
  const double right_m =
      (static_cast<double>(i % view.columns) + 0.5 - view.antenna_column) * view.metres_per_pixel;
  const double up_m =
      (view.antenna_row - 0.5 - static_cast<double>(i / view.columns)) * view.metres_per_pixel;
  return {std::hypot(right_m, up_m), core::degrees(std::atan2(right_m, up_m))};
}

}  // namespace

TEST_CASE("the PPI has no gaps inside the sector and nothing outside it", "[ppi]") {
  const Sensor sensor = tests::hivision();
  for (const Up up : {Up::north, Up::track}) {
    const double heading_rad = radians(200.0);
    const PpiView view = ppi_view(sensor, up, 700, heading_rad);
    const std::vector<double> grey = ppi_grey(sensor, bscope(100.0), heading_rad, view);
    int lit = 0;
    for (int row = 0; row < view.rows; ++row) {
      for (int column = 0; column < view.columns; ++column) {
        const double right_m = (column + 0.5 - view.antenna_column) * view.metres_per_pixel;
        const double up_m = (view.antenna_row - row - 0.5) * view.metres_per_pixel;
        const double range_m = std::hypot(right_m, up_m);
        const double bearing = std::atan2(right_m, up_m) - (up == Up::north ? heading_rad : 0.0);
        const double azimuth_deg = core::degrees(std::remainder(bearing, 2.0 * core::kPi));
        const bool inside =
            range_m > 200.001 && range_m < 3695.079 && std::abs(azimuth_deg) < 20.499;
        const bool outside =
            range_m < 199.999 || range_m > 3695.081 || std::abs(azimuth_deg) > 20.501;
        const double value = grey[static_cast<std::size_t>(row * view.columns + column)];
        if (inside) REQUIRE(value == Approx(100.0).epsilon(1e-12));
        if (outside) REQUIRE(value == 0.0);
        lit += inside;
      }
    }
    // Area of the sector: 41 deg / 2 (R2^2 - R1^2), in pixels of metres_per_pixel^2.
    const double area_px = 0.5 * radians(41.0) * (3695.08 * 3695.08 - 200.0 * 200.0) /
                           (view.metres_per_pixel * view.metres_per_pixel);
    CHECK(lit == Approx(area_px).epsilon(0.01));
  }
}

TEST_CASE("a target appears at its bearing, north up by true heading, track up without", "[ppi]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> grey = bscope(0.0);
  const int row = range_row(sensor.range, 2000.0);
  const int column = azimuth_column(sensor.scan, radians(10.1));
  grey[static_cast<std::size_t>(row * 164 + column)] = 255.0;

  PpiView view = ppi_view(sensor, Up::track, 2000, radians(264.74));
  Polar seen = brightest(view, ppi_grey(sensor, grey, radians(264.74), view));
  CHECK(seen.range_m == Approx(2000.0).epsilon(0.0).margin(7.0));
  CHECK(seen.bearing_deg == Approx(10.1).epsilon(0.0).margin(0.25));

  view = ppi_view(sensor, Up::north, 2400, radians(264.74));
  seen = brightest(view, ppi_grey(sensor, grey, radians(264.74), view));
  CHECK(seen.range_m == Approx(2000.0).epsilon(0.0).margin(7.0));
  CHECK(seen.bearing_deg == Approx(264.74 + 10.1 - 360.0).epsilon(0.0).margin(0.25));
}

namespace {

// Four edges of what is lit, as columns and rows free of it.
struct Spare {
  int left, right, above, below;
};
Spare spare_of(const PpiView& view, const std::vector<double>& grey) {
  Spare spare{view.columns, view.columns, view.rows, view.rows};
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns; ++column)
      if (grey[static_cast<std::size_t>(row * view.columns + column)] > 0.0)
        spare = {std::min(spare.left, column), std::min(spare.right, view.columns - 1 - column),
                 std::min(spare.above, row), std::min(spare.below, view.rows - 1 - row)};
  return spare;
}

Sensor with_sector(double field_of_view_deg) {
  Sensor sensor = tests::hivision();
  sensor.scan.field_of_view_rad = radians(field_of_view_deg);
  return sensor;
}

}  // namespace

TEST_CASE("the track-up plan view is cropped to the sector and the antenna", "[ppi]") {
  const Sensor sensor = tests::hivision();
  const PpiView view = ppi_view(sensor, Up::track, 700, 0.0);
  // 700 rows for 3695.08 m; 2 x 700 sin(20.5 deg) = 490.3 columns, rounded up to even.
  CHECK(view.metres_per_pixel * 700 == Approx(3695.08));
  CHECK(view.columns == 492);
  CHECK(view.rows == 700);
  CHECK(view.antenna_column == 246.0);
  CHECK(view.antenna_row == 700.0);

  for (const double sector_deg : {10.0, 41.0, 60.0, 61.0, 150.0, 180.0, 250.0, 360.0}) {
    CAPTURE(sector_deg);
    const Sensor wide = with_sector(sector_deg);
    const PpiView cropped = ppi_view(wide, Up::track, 300, 0.0);
    const std::vector<double> seen = ppi_grey(wide, bscope(100.0), 0.0, cropped);
    const Spare spare = spare_of(cropped, seen);
    // Nothing is free but what the antenna needs, less than two pixels beside what is seen.
    CHECK(spare.left <= 2);
    CHECK(spare.right <= 2);
    CHECK(spare.above <= 2);
    const double near_px =
        200.0 * std::cos(radians(std::min(180.0, sector_deg) / 2.0)) / cropped.metres_per_pixel;
    CHECK(spare.below <= near_px + 2);
    CHECK(cropped.columns % 2 == 0);
    CHECK(cropped.rows % 2 == 0);

    // Nothing that a square of 4 maximum ranges shows is missing.
    PpiView square = cropped;
    square.columns = square.rows = 1200;
    square.antenna_column = square.antenna_row = 600.0;
    const std::vector<double> all = ppi_grey(wide, bscope(100.0), 0.0, square);
    CHECK(std::count(all.begin(), all.end(), 100.0) == std::count(seen.begin(), seen.end(), 100.0));
  }
}

TEST_CASE("the north-up plan view holds the sector at any heading, in one size and scale",
          "[ppi]") {
  for (const double sector_deg : {10.0, 41.0, 90.0, 100.0, 180.0, 250.0, 360.0}) {
    const Sensor sensor = with_sector(sector_deg);
    const double scale = ppi_view(sensor, Up::north, 300, 0.0).metres_per_pixel;
    for (const double heading_deg : {0.0, 30.0, 90.0, 133.0, 264.74, 359.0}) {
      CAPTURE(sector_deg, heading_deg);
      const double heading_rad = radians(heading_deg);
      const PpiView view = ppi_view(sensor, Up::north, 300, heading_rad);
      CHECK(view.columns == 300);
      CHECK(view.rows == 300);
      CHECK(view.metres_per_pixel == scale);
      CHECK((view.antenna_column >= 0.0 && view.antenna_column <= 300.0));
      CHECK((view.antenna_row >= 0.0 && view.antenna_row <= 300.0));
      const std::vector<double> seen = ppi_grey(sensor, bscope(100.0), heading_rad, view);
      PpiView around = view;  // a frame of 300 pixels more
      around.columns = around.rows = 900;
      around.antenna_column += 300.0;
      around.antenna_row += 300.0;
      const std::vector<double> all = ppi_grey(sensor, bscope(100.0), heading_rad, around);
      CHECK(std::count(all.begin(), all.end(), 100.0) ==
            std::count(seen.begin(), seen.end(), 100.0));
    }
  }
  // Circle through the antenna and the far corners: R / cos(20.5 deg) wide.
  const PpiView hivision = ppi_view(tests::hivision(), Up::north, 512, 0.0);
  CHECK(hivision.metres_per_pixel * 512 == Approx(3695.08 / std::cos(radians(20.5))));
}

TEST_CASE("R17 a PPI of absurd size or scale is refused", "[ppi]") {
  const Sensor sensor = tests::hivision();
  for (const int size : {0, -1, 100000})
    CHECK_THROWS_AS(ppi_view(sensor, Up::north, size, 0.0), core::InputError);
  CHECK_THROWS_AS(ppi_view(sensor, Up::north, 64, std::nan("")), core::InputError);
  PpiView view = ppi_view(sensor, Up::north, 64, 0.0);
  const auto refused = [&](const PpiView& bad, double heading_rad) {
    CHECK_THROWS_AS(ppi_grey(sensor, bscope(0.0), heading_rad, bad), core::InputError);
  };
  refused(view, std::nan(""));
  view.metres_per_pixel = 0.0;
  refused(view, 0.0);
  view.metres_per_pixel = std::nan("");
  refused(view, 0.0);
  view = ppi_view(sensor, Up::north, 64, 0.0);
  view.rows = 100000;
  refused(view, 0.0);
}
