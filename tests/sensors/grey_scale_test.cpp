#include "sensors/display/grey_scale.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "core/errors.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/display/display.h"
#include "sensors/display/seed_signal.h"
#include "tests/sensors/numbers.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using tests::kInfinity;

namespace {

core::ErrorClass class_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    for (const auto candidate : {core::ErrorClass::nonfinite, core::ErrorClass::range})
      if (error.has(candidate)) return candidate;
  }
  return core::ErrorClass::io;  // none of those expected
}

}  // namespace

TEST_CASE("S07 eight-bit conversion clamps, rounds halves up and refuses NaN", "[grey_scale]") {
  CHECK(grey8(0.0) == 0);
  CHECK(grey8(255.0) == 255);
  CHECK(grey8(-1.0) == 0);
  CHECK(grey8(256.0) == 255);
  CHECK(grey8(300.0) == 255);
  CHECK(grey8(1e300) == 255);
  CHECK(grey8(kInfinity) == 255);
  CHECK(grey8(-kInfinity) == 0);
  for (int k = 0; k < 255; ++k) {
    REQUIRE(grey8(k + 0.5) == k + 1);
    REQUIRE(grey8(std::nextafter(k + 0.5, 0.0)) == k);
  }
  CHECK(grey8(0.49999999999999994) == 0);  // floor(x + 0.5) gives 1
  CHECK(class_of([] { grey8(std::nan("")); }) == core::ErrorClass::nonfinite);
}

TEST_CASE("S08 there is no dither: 100.3 grey levels are 100 in every pixel, every time",
          "[grey_scale]") {
  const std::vector<double> grey(1'000'000, 100.3);
  std::vector<std::uint8_t> first(grey.size()), second(grey.size());
  round_greys(grey, first.data());
  round_greys(grey, second.data());
  CHECK(static_cast<std::size_t>(std::count(first.begin(), first.end(), 100)) == first.size());
  CHECK(first == second);
}

TEST_CASE("S07 the display window maps low to 0, high to 255 and clamps beyond", "[grey_scale]") {
  const GreyScale scale(tests::hivision());
  const double step_dB = 60.0 / 255.0;
  CHECK(step_dB == Approx(0.235).epsilon(0.0).margin(0.0005));
  CHECK(scale.grey_of_level(-55.0) == 0.0);
  CHECK(scale.grey_of_level(5.0) == 255.0);
  CHECK(scale.grey_of_level(-55.0 - step_dB) == 0.0);
  CHECK(scale.grey_of_level(5.0 + step_dB) == 255.0);
  CHECK(scale.grey_of_level(kInfinity) == 255.0);
  CHECK(scale.grey_of_level(-kInfinity) == 0.0);
  CHECK(scale.grey_of_level(-55.0 + 100.0 * step_dB) == Approx(100.0).epsilon(1e-12));
  CHECK(scale.grey_of_level(-55.0 + 100.5 * step_dB) == Approx(100.5).epsilon(1e-12));
  CHECK(class_of([&] { scale.grey_of_level(std::nan("")); }) == core::ErrorClass::nonfinite);
}

TEST_CASE("S07 grey never decreases as the level rises", "[grey_scale]") {
  const GreyScale scale(tests::hivision());
  double before = 0.0;
  int before8 = 0;
  for (int i = 0; i <= 140000; ++i) {
    const double grey = scale.grey_of_level(-60.0 + 0.0005 * i);
    REQUIRE(grey >= before);
    REQUIRE(grey8(grey) >= before8);
    before = grey;
    before8 = grey8(grey);
  }
}

TEST_CASE("stc shows flat ground of any NRCS at the same grey over the whole range",
          "[grey_scale]") {
  // The published table's convention is for the mapping seed alone.
  for (const char* file : {"hivision.toml", "hivision-seed.toml"}) {
    Sensor sensor = tests::shipped_sensor(file);
    sensor.display.mapping = Display::Mapping::stc;
    sensor.display.low_dB = -55.0;
    sensor.display.high_dB = 5.0;
    const GreyScale scale(sensor);
    const double nrcs_dB = -25.0;
    for (const int row : {0, 100, 523}) {
      const double range_m = 200.0 + (row + 0.5) * 6.67;
      // Radar equation on a patch R phi dR: three powers of R remain.
      const double power_W = sensor.radar_constant_W_m2() * std::pow(10.0, nrcs_dB / 10.0) *
                             two_way_width(sensor.antenna.azimuth) * 6.67 / std::pow(range_m, 3);
      CHECK(scale.level_dB(power_W, row) == Approx(nrcs_dB).epsilon(1e-12));
      CHECK(scale.bscope_grey(power_W, row) == Approx(255.0 * 30.0 / 60.0).epsilon(1e-12));
      CHECK(scale.cscope_grey(power_W * std::pow(range_m, 3)) ==
            Approx(255.0 * 30.0 / 60.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("stc compensates a known loss", "[grey_scale]") {
  Sensor sensor = tests::hivision();
  const double level_dB = GreyScale(sensor).level_dB(1e-12, 10);
  sensor.receiver.loss = 2.0;
  CHECK(GreyScale(sensor).level_dB(0.5e-12, 10) == Approx(level_dB).epsilon(1e-12));
}

TEST_CASE("log shows received power in dBW whatever the range", "[grey_scale]") {
  Sensor sensor = tests::hivision();
  sensor.display.mapping = Display::Mapping::log;
  sensor.display.low_dB = -170.0;
  sensor.display.high_dB = -70.0;
  const GreyScale scale(sensor);
  for (const int row : {0, 523}) CHECK(scale.bscope_grey(1e-12, row) == Approx(127.5));
  // The C-scope: the same power in each of the 524 range cells, shared evenly among 524 rows. The
  // sum of R^3 over the cells is (R2^4 - R1^4) / (4 cell) within 1e-5 (midpoint rule).
  const double shared_m3 = (std::pow(3695.08, 4) - std::pow(200.0, 4)) / (4.0 * 6.67) / 524.0;
  CHECK(scale.cscope_level_dB(1e-12 * shared_m3) == Approx(-120.0).epsilon(0.0).margin(1e-4));
  CHECK(scale.cscope_grey(1e-12 * shared_m3) == Approx(127.5).epsilon(1e-5));
}

TEST_CASE("under log the noise is the same grey in the C-scope as in the B-scope", "[grey_scale]") {
  for (const char* file : {"automotive-76.toml", "hivision.toml"}) {
    Sensor sensor = tests::shipped_sensor(file);
    sensor.display.mapping = Display::Mapping::log;
    sensor.display.low_dB = -180.0;
    sensor.display.high_dB = -80.0;
    for (const int rows : {16, 128, 524}) {
      sensor.display.cscope_rows = rows;
      const GreyScale scale(sensor);
      const double noise_grey = scale.bscope_grey(sensor.noise_power_W(), 7);
      CHECK(noise_grey > 1.0);
      CHECK(scale.cscope_grey(cscope_noise_W_m3(sensor)) == Approx(noise_grey).epsilon(1e-9));
      CHECK(scale.cscope_floor_W_m3() ==
            Approx(cscope_noise_W_m3(sensor) / sensor.noise_power_W() * 1e-18).epsilon(1e-9));
    }
  }
}

TEST_CASE("seed maps its minimum signal to 0 and its maximum to 255, linear in dB",
          "[grey_scale]") {
  const Sensor sensor = tests::shipped_sensor("hivision-seed.toml");
  const GreyScale scale(sensor);
  const SignalLimits limits = seed_signal_limits(sensor);
  CHECK(scale.bscope_grey(limits.minimum_W * (1.0 - 1e-12), 400) == 0.0);
  CHECK(scale.bscope_grey(limits.maximum_W * (1.0 + 1e-12), 400) == 255.0);
  CHECK(scale.bscope_grey(std::sqrt(limits.minimum_W * limits.maximum_W), 400) ==
        Approx(127.5).epsilon(1e-9));
  CHECK(scale.high_dB() - scale.low_dB() == Approx(38.0152).epsilon(0.0).margin(1e-4));
}

TEST_CASE("M02 zero power is grey 0 under every mapping, and the smallest power is no surprise",
          "[grey_scale]") {
  for (const auto mapping :
       {Display::Mapping::stc, Display::Mapping::log, Display::Mapping::seed}) {
    Sensor sensor = tests::hivision();
    sensor.display.mapping = mapping;
    const GreyScale scale(sensor);
    CHECK(scale.level_dB(0.0, 0) == -kInfinity);
    CHECK(scale.bscope_grey(0.0, 0) == 0.0);
    CHECK(scale.cscope_grey(0.0) == 0.0);
    CHECK(scale.bscope_grey(5e-324, 523) == 0.0);
  }
}

TEST_CASE("power that is negative or not a number is refused before it becomes grey",
          "[grey_scale]") {
  const GreyScale scale(tests::hivision());
  CHECK(class_of([&] { scale.bscope_grey(std::nan(""), 0); }) == core::ErrorClass::nonfinite);
  CHECK(class_of([&] { scale.bscope_grey(-1e-20, 0); }) == core::ErrorClass::range);
  CHECK(class_of([&] { scale.cscope_grey(std::nan("")); }) == core::ErrorClass::nonfinite);
}
