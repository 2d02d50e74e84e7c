#include "sensors/cells.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.h"
#include "tests/sensors/numbers.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::kPi;
using core::radians;
using tests::kInfinity;

namespace {

Scan full_circle(int columns) {
  Scan scan;
  scan.field_of_view_rad = radians(360.0);
  scan.columns = columns;
  return scan;
}

// In how many columns an azimuth lies by the definition of their edges.
int columns_holding(const Scan& scan, double azimuth_rad) {
  int count = 0;
  for (int k = 0; k < scan.columns; ++k)
    count += azimuth_rad >= column_edge_rad(scan, k) && azimuth_rad < column_edge_rad(scan, k + 1);
  return count;
}

}  // namespace

TEST_CASE("R06 a range exactly on a cell's edge belongs to the cell that begins there", "[cells]") {
  for (const double cell_m : {0.1, 0.15, 0.3, 0.7, 1.1, 1.2, 3.75}) {
    const RangeGate gate{0.0, cell_m, 4000};
    int wrong_by_division = 0;
    for (int k = 0; k < 4000; ++k) {
      const double range_m = k * cell_m;
      REQUIRE(range_row(gate, range_m) == k);
      if (k > 0) REQUIRE(range_row(gate, std::nextafter(range_m, 0.0)) == k - 1);
      wrong_by_division += static_cast<int>(std::floor(range_m / cell_m)) != k;
    }
    // The case is only a case where the short way fails (figures of the catalogue).
    if (cell_m == 0.1) CHECK(wrong_by_division == 200);
    if (cell_m == 0.3) CHECK(wrong_by_division == 251);
    CHECK(range_row(gate, 4000 * cell_m) == kOutside);
  }
}

TEST_CASE("R06 every edge of HiVision's range gate begins its own row", "[cells]") {
  const RangeGate gate = tests::hivision().range;
  for (int k = 0; k < gate.cells; ++k) {
    REQUIRE(range_row(gate, 200.0 + k * 6.67) == k);
    REQUIRE(range_row(gate, range_middle_m(gate, k)) == k);
    REQUIRE(range_row(gate, std::nextafter(range_edge_m(gate, k + 1), 0.0)) == k);
  }
  CHECK(range_row(gate, gate.maximum_m()) == kOutside);
  CHECK(range_row(gate, std::nextafter(200.0, 0.0)) == kOutside);
  for (const double range_m : {-1.0, 0.0, 1e300, kInfinity, -kInfinity, std::nan("")})
    CHECK(range_row(gate, range_m) == kOutside);
}

TEST_CASE("S04 a target on a column's edge lies in exactly one column", "[cells]") {
  const Scan scan = tests::hivision().scan;
  for (int k = 0; k < scan.columns; ++k) {
    REQUIRE(azimuth_column(scan, column_edge_rad(scan, k)) == k);
    // The same edge computed in degrees: rounding may put it on either side, but on one only.
    const double azimuth_rad = radians(-20.5 + 0.25 * k);
    REQUIRE(columns_holding(scan, azimuth_rad) == 1);
    const int column = azimuth_column(scan, azimuth_rad);
    REQUIRE((column == k || column == k - 1));
    REQUIRE(azimuth_rad >= column_edge_rad(scan, column));
    REQUIRE(azimuth_rad < column_edge_rad(scan, column + 1));
  }
  CHECK(azimuth_column(scan, radians(-20.5)) == 0);
  CHECK(azimuth_column(scan, radians(20.5)) == kOutside);
  CHECK(azimuth_column(scan, std::nextafter(radians(20.5), 0.0)) == 163);
  CHECK(azimuth_column(scan, std::nextafter(radians(-20.5), -1.0)) == kOutside);
  for (const double azimuth_rad : {kPi, -kPi, kInfinity, std::nan("")})
    CHECK(azimuth_column(scan, azimuth_rad) == kOutside);
}

TEST_CASE("S04 in a full circle +180 and -180 deg are one target in one column", "[cells]") {
  for (const int columns : {1, 7, 360, 4096}) {
    const Scan scan = full_circle(columns);
    CHECK(azimuth_column(scan, kPi) == 0);
    CHECK(azimuth_column(scan, -kPi) == 0);
    CHECK(azimuth_column(scan, std::nextafter(kPi, 0.0)) == columns - 1);
    CHECK(azimuth_column(scan, 3.0 * kPi) == 0);
    for (int k = 0; k < columns; ++k) REQUIRE(azimuth_column(scan, column_edge_rad(scan, k)) == k);
    CHECK(azimuth_column(scan, std::nan("")) == kOutside);
    CHECK(azimuth_column(scan, kInfinity) == kOutside);
  }
}

TEST_CASE("S04 no azimuth of the field of view is lost or counted twice", "[cells]") {
  Scan scan;
  scan.field_of_view_rad = radians(41.3);
  scan.columns = 61;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto words = core::random_words({7, core::kStreamTerrain, 0}, i, 0);
    const double azimuth_rad = scan.field_of_view_rad * (core::uniform_from(words[0]) - 0.5);
    REQUIRE(columns_holding(scan, azimuth_rad) == 1);
    const int column = azimuth_column(scan, azimuth_rad);
    REQUIRE(column != kOutside);
    REQUIRE(azimuth_rad >= column_edge_rad(scan, column));
    REQUIRE(azimuth_rad < column_edge_rad(scan, column + 1));
  }
}

TEST_CASE("C-scope rows run from the top down and the lower edge is outside", "[cells]") {
  const Display display = tests::hivision().display;
  CHECK(cscope_row(display, display.cscope_top_rad) == 0);
  CHECK(cscope_row(display, radians(1.21)) == kOutside);
  CHECK(cscope_row(display, radians(-3.8 - 1e-9)) == 262);
  CHECK(cscope_row(display, radians(-8.79)) == 523);
  CHECK(cscope_row(display, radians(-8.81)) == kOutside);
  CHECK(cscope_row(display, std::nan("")) == kOutside);
}
