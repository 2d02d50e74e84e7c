// Azimuth as a function of frequency.
#include "sensors/antenna/frequency_scan.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::kSpeedOfLight_mps;
using core::radians;

namespace {

// WR-28 guide (cutoff 21.077 GHz), folded eight times per spacing of 5 mm.
FrequencyScan folded_guide() {
  FrequencyScan scan;
  scan.line_length_per_spacing = 8.0;
  scan.cutoff_Hz = 21.077e9;
  scan.spacing_m = 5e-3;
  scan.mode = 4;
  return scan;
}

// The law of the header.
double azimuth_rad_at(const FrequencyScan& scan, double frequency_Hz) {
  const double cut = scan.cutoff_Hz / frequency_Hz;
  const double order_Hz = scan.mode * kSpeedOfLight_mps / scan.spacing_m;
  return std::asin(scan.line_length_per_spacing * std::sqrt(1.0 - cut * cut) -
                   order_Hz / frequency_Hz);
}

}  // namespace

TEST_CASE("the beam stands broadside where the line is a whole number of guide wavelengths",
          "[frequency_scan]") {
  const FrequencyScan scan = folded_guide();
  const double length_m = scan.line_length_per_spacing * scan.spacing_m;
  // L = m lambda_g with 1 / lambda_g^2 = (f^2 - fc^2) / c^2.
  const double f0_Hz = std::hypot(scan.cutoff_Hz, scan.mode * kSpeedOfLight_mps / length_m);
  CHECK(*frequency_towards_Hz(scan, 0.0) == Approx(f0_Hz).epsilon(1e-14));
}

TEST_CASE("a feed line without dispersion scans as sin(theta) = (L/d) (1 - f0/f)",
          "[frequency_scan]") {
  FrequencyScan scan = folded_guide();
  scan.cutoff_Hz = 0.0;
  const double f0_Hz =
      scan.mode * kSpeedOfLight_mps / (scan.line_length_per_spacing * scan.spacing_m);
  for (const double ratio : {0.97, 1.0, 1.03})
    CHECK(*frequency_towards_Hz(scan, std::asin(8.0 * (1.0 - 1.0 / ratio))) ==
          Approx(ratio * f0_Hz).epsilon(1e-12));
}

TEST_CASE("the beam points where its frequency was asked for, and the rate is the slope",
          "[frequency_scan]") {
  FrequencyScan order_zero = folded_guide();
  order_zero.mode = 0;
  order_zero.line_length_per_spacing = 1.0;
  for (const FrequencyScan& scan : {folded_guide(), order_zero})
    for (const double azimuth_deg : {-20.0, -3.0, 0.5, 20.0}) {
      const double azimuth_rad = radians(azimuth_deg);
      const auto frequency_Hz = frequency_towards_Hz(scan, azimuth_rad);
      if (scan.mode == 0 && azimuth_deg < 0.0) {
        CHECK_FALSE(frequency_Hz);  // a line without slow order looks ahead only
        continue;
      }
      REQUIRE(frequency_Hz);
      CHECK(azimuth_rad_at(scan, *frequency_Hz) == Approx(azimuth_rad).epsilon(1e-10));
      const double step_Hz = 1e3;
      const double slope = (azimuth_rad_at(scan, *frequency_Hz + step_Hz) -
                            azimuth_rad_at(scan, *frequency_Hz - step_Hz)) /
                           (2.0 * step_Hz);
      CHECK(steering_rate_rad_per_Hz(scan, azimuth_rad) == Approx(slope).epsilon(1e-5));
    }
  FrequencyScan table;
  table.law = FrequencyScan::Law::table;
  table.table_frequency_Hz = {34e9, 35e9, 36.5e9};
  table.table_azimuth_rad = {radians(-25.0), radians(1.0), radians(25.0)};
  CHECK(*frequency_towards_Hz(table, radians(-12.0)) == Approx(34.5e9).epsilon(1e-12));
  CHECK(*frequency_towards_Hz(table, radians(13.0)) == Approx(35.75e9).epsilon(1e-12));
  CHECK(steering_rate_rad_per_Hz(table, radians(-3.0)) == Approx(radians(26.0) / 1e9));
  CHECK(steering_rate_rad_per_Hz(table, radians(20.0)) == Approx(radians(24.0) / 1.5e9));
}

TEST_CASE("what a law cannot reach has no answer", "[frequency_scan]") {
  const FrequencyScan scan = folded_guide();
  CHECK_FALSE(frequency_towards_Hz(scan, std::nan("")));
  FrequencyScan table;
  table.law = FrequencyScan::Law::table;
  table.table_frequency_Hz = {34e9, 36e9};
  table.table_azimuth_rad = {-0.3, 0.3};
  CHECK_FALSE(frequency_towards_Hz(table, -0.31));
  CHECK_FALSE(frequency_towards_Hz(table, 0.31));
  CHECK(*frequency_towards_Hz(table, 0.3) == 36e9);
}

TEST_CASE("columns know their frequency, wavelength and rate", "[frequency_scan]") {
  Sensor sensor = tests::hivision();
  CHECK(neglected_steering_dB(sensor) == 0.0);
  FrequencyScan table;
  table.law = FrequencyScan::Law::table;
  table.table_frequency_Hz = {34e9, 36e9};
  table.table_azimuth_rad = {radians(-20.5), radians(20.5)};
  sensor.scan.frequency_scan = table;
  const SteeredColumn last = steered_column(sensor, 163);
  CHECK(core::degrees(last.azimuth_rad) == Approx(20.375));
  CHECK(last.frequency_Hz == Approx(35e9 + 1e9 * 20.375 / 20.5));
  CHECK(last.wavelength_m == Approx(kSpeedOfLight_mps / last.frequency_Hz));
  CHECK(core::degrees(last.rate_rad_per_Hz) * 1e6 == Approx(0.0205));  // deg per MHz
  // cos^2: -0.561 dB, wavelength: +0.243 dB at the upper end, -0.251 dB at the lower.
  CHECK(neglected_steering_dB(sensor) == Approx(0.811).epsilon(0.0).margin(2e-3));
}
