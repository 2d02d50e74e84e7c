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
  for (const auto resampling : {PpiView::Resampling::nearest, PpiView::Resampling::bilinear}) {
    for (const Up up : {Up::north, Up::track}) {
      PpiView view = ppi_view(sensor, up, 700);
      view.resampling = resampling;
      const double heading_rad = radians(200.0);
      const std::vector<double> grey = ppi_grey(sensor, bscope(100.0), heading_rad, view);
      int lit = 0;
      for (int row = 0; row < 700; ++row) {
        for (int column = 0; column < 700; ++column) {
          const double right_m = (column + 0.5 - view.antenna_column) * view.metres_per_pixel;
          const double up_m = (view.antenna_row - row - 0.5) * view.metres_per_pixel;
          const double range_m = std::hypot(right_m, up_m);
          const double bearing = std::atan2(right_m, up_m) - (up == Up::north ? heading_rad : 0.0);
          const double azimuth_deg = core::degrees(std::remainder(bearing, 2.0 * core::kPi));
          const bool inside =
              range_m > 200.001 && range_m < 3695.079 && std::abs(azimuth_deg) < 20.499;
          const bool outside =
              range_m < 199.999 || range_m > 3695.081 || std::abs(azimuth_deg) > 20.501;
          const double value = grey[static_cast<std::size_t>(row * 700 + column)];
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
}

TEST_CASE("a target appears at its bearing, north up by true heading, track up without", "[ppi]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> grey = bscope(0.0);
  const int row = range_row(sensor.range, 2000.0);
  const int column = azimuth_column(sensor.scan, radians(10.1));
  grey[static_cast<std::size_t>(row * 164 + column)] = 255.0;

  PpiView view = ppi_view(sensor, Up::track, 2000);
  Polar seen = brightest(view, ppi_grey(sensor, grey, radians(264.74), view));
  CHECK(seen.range_m == Approx(2000.0).margin(7.0));
  CHECK(seen.bearing_deg == Approx(10.1).margin(0.25));

  view = ppi_view(sensor, Up::north, 2400);
  seen = brightest(view, ppi_grey(sensor, grey, radians(264.74), view));
  CHECK(seen.range_m == Approx(2000.0).margin(7.0));
  CHECK(seen.bearing_deg == Approx(264.74 + 10.1 - 360.0).margin(0.25));
}

TEST_CASE("the default view holds the whole sector", "[ppi]") {
  const Sensor sensor = tests::hivision();
  const PpiView track = ppi_view(sensor, Up::track, 512);
  CHECK(track.metres_per_pixel * 512 == Approx(3695.08));
  CHECK(track.antenna_row == 512.0);
  const PpiView north = ppi_view(sensor, Up::north, 512);
  CHECK(north.metres_per_pixel * 256 == Approx(3695.08));
  CHECK(north.antenna_row == 256.0);
}

TEST_CASE("bilinear goes straight from one cell's middle to the next", "[ppi]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> grey = bscope(0.0);
  for (int row = 0; row < 524; ++row)
    for (int column = 0; column < 164; ++column)
      grey[static_cast<std::size_t>(row * 164 + column)] = range_middle_m(sensor.range, row) / 20.0;
  PpiView view = ppi_view(sensor, Up::track, 900);
  view.resampling = PpiView::Resampling::bilinear;
  const std::vector<double> picture = ppi_grey(sensor, grey, 0.0, view);
  for (int row = 10; row < 840; row += 37) {
    const double range_m = std::hypot(0.5, 900.0 - row - 0.5) * view.metres_per_pixel;
    CHECK(picture[static_cast<std::size_t>(row * 900 + 450)] ==
          Approx(range_m / 20.0).epsilon(1e-9));
  }
}

TEST_CASE("R17 a PPI of absurd size or scale is refused", "[ppi]") {
  const Sensor sensor = tests::hivision();
  for (const int size : {0, -1, 100000})
    CHECK_THROWS_AS(ppi_view(sensor, Up::north, size), core::InputError);
  PpiView view = ppi_view(sensor, Up::north, 64);
  const auto refused = [&](const PpiView& bad, double heading_rad) {
    CHECK_THROWS_AS(ppi_grey(sensor, bscope(0.0), heading_rad, bad), core::InputError);
  };
  refused(view, std::nan(""));
  view.metres_per_pixel = 0.0;
  refused(view, 0.0);
  view.metres_per_pixel = std::nan("");
  refused(view, 0.0);
  view = ppi_view(sensor, Up::north, 64);
  view.rows = 100000;
  refused(view, 0.0);
}
