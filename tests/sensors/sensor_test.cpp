// The figures that the shipped sensors must give.
#include "sensors/sensor.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/display/seed_signal.h"
#include "tests/decibel.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using tests::dB;

TEST_CASE("HiVision has the geometry of its published table", "[sensor]") {
  const Sensor sensor = tests::hivision();
  CHECK(sensor.scan.columns == 164);
  CHECK(core::degrees(sensor.scan.column_width_rad()) == Approx(0.25).epsilon(1e-14));
  CHECK(sensor.range.cells == 524);
  CHECK(sensor.range.maximum_m() == Approx(3695.08).epsilon(1e-14));
  CHECK(sensor.scan.frame_rate_Hz == 16.0);
  CHECK(sensor.display.cscope_rows == 524);
  CHECK(core::degrees(sensor.display.cscope_top_rad) == Approx(1.2).epsilon(1e-14));
  CHECK(core::degrees(sensor.display.cscope_top_rad - sensor.display.cscope_span_rad) ==
        Approx(-8.8).epsilon(1e-14));
  // The range cell is what the bandwidth resolves, to the five digits given.
  CHECK(299792458.0 / (2.0 * sensor.waveform.bandwidth_Hz) == Approx(6.67).epsilon(1e-5));
}

TEST_CASE("HiVision's gain is 35.12 dB, 0.714 times its directivity", "[sensor]") {
  const Sensor sensor = tests::hivision();
  CHECK(sensor.antenna.peak_gain == Approx(26000.0 / (0.8 * 10.0)).epsilon(1e-14));
  CHECK(dB(sensor.antenna.peak_gain) == Approx(35.12).epsilon(0.0).margin(0.005));
  CHECK(sensor.antenna.efficiency == Approx(0.714).epsilon(0.0).margin(0.0005));
  CHECK(core::degrees(sensor.azimuth_patch_rad()) == Approx(0.60215).epsilon(0.0).margin(1e-5));
}

TEST_CASE("both cuts of HiVision end at the same two-way level", "[sensor]") {
  const Antenna antenna = tests::hivision().antenna;
  // exp(-8 ln2 (1.25 / 0.8)^2)
  CHECK(dB(two_way_gain(antenna.azimuth, antenna.azimuth.cut_rad)) ==
        Approx(-58.795).epsilon(0.0).margin(1e-3));
  CHECK(dB(two_way_gain(antenna.elevation, antenna.elevation.cut_rad)) ==
        Approx(-58.795).epsilon(0.0).margin(1e-3));
}

TEST_CASE("HiVision's mean noise is k T0 F over one column's dwell", "[sensor]") {
  const Sensor sensor = tests::hivision();
  CHECK(sensor.receiver.dwell_s == Approx(0.381e-3).epsilon(0.0).margin(0.5e-6));
  // 1.380649e-23 J/K x 290 K x 10^0.6 x 2624 Hz
  CHECK(sensor.noise_power_W() == Approx(4.18258e-17).epsilon(1e-5));
}

TEST_CASE("the radar equation's constant takes gain and wavelength squared and loss once",
          "[sensor]") {
  Sensor sensor = tests::hivision();
  // 1 W x 3250^2 x (299792458 / 35e9 m)^2 / (4 pi)^3
  const double expected_W_m2 =
      3250.0 * 3250.0 * std::pow(299792458.0 / 35e9, 2) / std::pow(4.0 * 3.14159265358979, 3);
  CHECK(sensor.radar_constant_W_m2() == Approx(expected_W_m2).epsilon(1e-12));
  sensor.receiver.loss = 2.0;
  CHECK(sensor.radar_constant_W_m2() == Approx(expected_W_m2 / 2.0).epsilon(1e-12));
}

TEST_CASE("hivision-seed gives the published table's figures to 1e-6", "[sensor]") {
  const Sensor sensor = tests::shipped_sensor("hivision-seed.toml");
  CHECK(sensor.wavelength_m() == Approx(8.571429e-3).epsilon(1e-6));
  CHECK(sensor.antenna.peak_gain == Approx(1805.5556).epsilon(1e-6));
  CHECK(dB(sensor.antenna.peak_gain) == Approx(32.5661).epsilon(1e-6));
  const SignalLimits limits = seed_signal_limits(sensor);
  CHECK(limits.constant_power_W_m3 == Approx(0.13289873).epsilon(1e-6));
  CHECK(limits.minimum_W == Approx(2.6237090e-12).epsilon(1e-6));
  CHECK(limits.maximum_W == Approx(1.6612341e-8).epsilon(1e-6));
  CHECK(dB(limits.maximum_W / limits.minimum_W) == Approx(38.0152).epsilon(0.0).margin(0.00005));
  CHECK(sensor.range.cells == 524);
  CHECK(sensor.display.mapping == Display::Mapping::seed);
}

TEST_CASE("a sensor without the seed's convention uses its own cell and beam for the signal limits",
          "[sensor]") {
  Sensor sensor = tests::hivision();
  const SignalLimits limits = seed_signal_limits(sensor);
  CHECK(limits.constant_power_W_m3 ==
        Approx(sensor.radar_constant_W_m2() * core::radians(0.6021535) * 6.67).epsilon(2e-6));
  CHECK(limits.minimum_W ==
        Approx(limits.constant_power_W_m3 / std::pow(3695.08, 3)).epsilon(1e-12));
  sensor.range.minimum_m = 0.0;
  CHECK_THROWS_AS(seed_signal_limits(sensor), core::InputError);
}
