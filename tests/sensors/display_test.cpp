#include "sensors/display/display.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/errors.h"
#include "core/units.h"
#include "sensors/cells.h"
#include "tests/sensors/numbers.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::radians;
using tests::cubed;
using tests::kInfinity;

namespace {

std::vector<double> bscope_of(const Sensor& sensor, double value) {
  return std::vector<double>(static_cast<std::size_t>(sensor.range.cells * sensor.scan.columns),
                             value);
}

}  // namespace

TEST_CASE("the B-scope picture has the farthest range on top and left stays left", "[display]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> grey = bscope_of(sensor, 0.0);
  grey[0 * 164 + 3] = 10.0;      // nearest
  grey[523 * 164 + 160] = 20.4;  // farthest
  const Picture8 picture = bscope_picture(sensor, grey);
  REQUIRE(picture.columns == 164);
  REQUIRE(picture.rows == 524);
  CHECK(picture.pixels[523 * 164 + 3] == 10);
  CHECK(picture.pixels[0 * 164 + 160] == 20);
  CHECK(std::accumulate(picture.pixels.begin(), picture.pixels.end(), 0) == 30);
}

TEST_CASE("the C-scope picture keeps the highest elevation on top", "[display]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> grey(524 * 164, 0.0);
  grey[5] = 200.0;
  const Picture8 picture = cscope_picture(sensor, grey);
  CHECK(picture.pixels[5] == 200);
  CHECK(picture.rows == 524);
}

TEST_CASE("each range row is compensated with its own range", "[display]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> power_W = bscope_of(sensor, 0.0);
  const double unit = sensor.radar_constant_W_m2() * sensor.azimuth_patch_rad() * 6.67;
  for (int row = 0; row < 524; ++row)  // -20 dB everywhere in column 7
    power_W[static_cast<std::size_t>(row) * 164 + 7] =
        0.01 * unit / cubed(range_middle_m(sensor.range, row));
  const std::vector<double> grey = bscope_grey(sensor, power_W);
  for (std::size_t row = 0; row < 524; ++row) {
    REQUIRE(grey[row * 164 + 7] == Approx(255.0 * 35.0 / 60.0).epsilon(1e-12));
    REQUIRE(grey[row * 164 + 8] == 0.0);
  }
}

TEST_CASE("S07 a NaN anywhere in the power stops the picture", "[display]") {
  const Sensor sensor = tests::hivision();
  std::vector<double> power_W = bscope_of(sensor, 1e-15);
  power_W[77777] = std::nan("");
  CHECK_THROWS_AS(bscope_grey(sensor, power_W), core::InputError);
  CHECK_THROWS_AS(bscope_picture(sensor, power_W), core::InputError);
}

TEST_CASE("an array of another size is our own mistake", "[display]") {
  const Sensor sensor = tests::hivision();
  const std::vector<double> small(10);
  CHECK_THROWS_AS(bscope_grey(sensor, small), core::InternalError);
  CHECK_THROWS_AS(cscope_grey(sensor, small), core::InternalError);
  CHECK_THROWS_AS(bscope_picture(sensor, small), core::InternalError);
  CHECK_THROWS_AS(cscope_picture(sensor, small), core::InternalError);
  CHECK_THROWS_AS(flat_earth_cscope_W_m3(sensor, small, 100.0), core::InternalError);
}

TEST_CASE("M02 a dark picture shows the noise, and nothing without it", "[display]") {
  const Sensor sensor = tests::hivision();
  for (const double grey : bscope_grey(sensor, bscope_of(sensor, 0.0))) REQUIRE(grey == 0.0);
  const std::vector<double> noise = bscope_grey(sensor, bscope_of(sensor, sensor.noise_power_W()));
  // Noise is even in power, so it rises with R^3 under stc: 38 dB from the first row to the last.
  const double expected_dB = 30.0 * std::log10((200.0 + 523.5 * 6.67) / (200.0 + 0.5 * 6.67));
  CHECK(noise[0] == 0.0);  // -79 dB
  CHECK(noise[523 * 164] > 50.0);
  CHECK(noise[523 * 164] == Approx(255.0 / 60.0 * (55.0 - 41.1)).epsilon(0.0).margin(1.0));
  CHECK(expected_dB == Approx(37.7).epsilon(0.0).margin(0.1));
}

TEST_CASE("flat earth puts every range at the depression of flat ground and loses no power inside",
          "[display]") {
  const Sensor sensor = tests::hivision();
  const double height_m = 100.0;
  std::vector<double> power_W = bscope_of(sensor, 0.0);
  for (const int row : {150, 300, 523}) {
    std::fill(power_W.begin(), power_W.end(), 0.0);
    power_W[static_cast<std::size_t>(row) * 164 + 40] = 2.0;
    const std::vector<double> cscope = flat_earth_cscope_W_m3(sensor, power_W, height_m);
    const double range_m = range_middle_m(sensor.range, row);
    const int expected_row = cscope_row(sensor.display, -std::asin(height_m / range_m));
    CHECK(cscope[static_cast<std::size_t>(expected_row) * 164 + 40] > 0.0);
    CHECK(std::accumulate(cscope.begin(), cscope.end(), 0.0) ==
          Approx(2.0 * cubed(range_m)).epsilon(1e-12));
  }
}

TEST_CASE("flat earth leaves no row empty between the horizon and the window's lower edge",
          "[display]") {
  const Sensor sensor = tests::hivision();
  // At 300 m the first cells span 14 rows each; at 20 m many cells share one row.
  for (const double height_m : {20.0, 60.0, 300.0}) {
    const std::vector<double> cscope =
        flat_earth_cscope_W_m3(sensor, bscope_of(sensor, 1e-12), height_m);
    const int first = cscope_row(sensor.display, -std::asin(height_m / 3695.08));
    const int last = height_m / 200.0 < std::sin(radians(8.8))
                         ? cscope_row(sensor.display, -std::asin(height_m / 200.0))
                         : 523;
    REQUIRE(first > 0);
    for (int row = 0; row < 524; ++row) {
      INFO("height " << height_m << " row " << row);
      const double value = cscope[static_cast<std::size_t>(row) * 164 + 100];
      REQUIRE((value > 0.0) == (row >= first && row <= last));
    }
  }
}

TEST_CASE("flat earth shares a cell's power in proportion to the elevation covered", "[display]") {
  Sensor sensor = tests::hivision();
  sensor.display.cscope_rows = 4096;  // 0.00244 deg each
  std::vector<double> power_W = bscope_of(sensor, 0.0);
  power_W[500] = 1.0;  // row 3, column 8
  const double height_m = 20.0;
  const std::vector<double> cscope = flat_earth_cscope_W_m3(sensor, power_W, height_m);
  const double low = -std::asin(height_m / range_edge_m(sensor.range, 3));
  const double high = -std::asin(height_m / range_edge_m(sensor.range, 4));
  const double row_rad = sensor.display.cscope_span_rad / 4096;
  const int middle = cscope_row(sensor.display, 0.5 * (low + high));
  const double expected = cubed(range_middle_m(sensor.range, 3)) * row_rad / (high - low);
  for (int row = middle - 10; row <= middle + 10; ++row)
    CHECK(cscope[static_cast<std::size_t>(row) * 164 + 8] == Approx(expected).epsilon(1e-9));
}

TEST_CASE("flat earth refuses a height that is not above ground", "[display]") {
  const Sensor sensor = tests::hivision();
  const std::vector<double> power_W = bscope_of(sensor, 0.0);
  for (const double height_m : {0.0, -5.0, std::nan(""), kInfinity})
    CHECK_THROWS_AS(flat_earth_cscope_W_m3(sensor, power_W, height_m), core::InputError);
  // Higher than the farthest range: no ground in view, nothing to show.
  for (const double value : flat_earth_cscope_W_m3(sensor, bscope_of(sensor, 1.0), 5000.0))
    REQUIRE(value == 0.0);
}

TEST_CASE("the C-scope's noise adds up to that of the B-scope, range-compensated", "[display]") {
  const Sensor sensor = tests::hivision();
  // Sum of R^3 over the cells is (R2^4 - R1^4) / (4 cell) within 1e-5 (midpoint rule).
  const double sum_m3 = (std::pow(3695.08, 4) - std::pow(200.0, 4)) / (4.0 * 6.67);
  CHECK(524.0 * cscope_noise_W_m3(sensor) == Approx(sensor.noise_power_W() * sum_m3).epsilon(1e-5));
  CHECK(cscope_grey(sensor, std::vector<double>(524 * 164, cscope_noise_W_m3(sensor)))[0] ==
        Approx(255.0 / 60.0 * (55.0 - 46.9)).epsilon(0.0).margin(0.5));
}
