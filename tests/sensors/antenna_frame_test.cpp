#include "sensors/antenna/antenna_frame.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/errors.h"
#include "core/pose.h"
#include "core/units.h"
#include "tests/sensors/numbers.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::kPi;
using core::radians;
using tests::kInfinity;

namespace {

// North, east, down in a scene frame of east, north, up.
const glm::dmat3 kNed{{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};

glm::dquat attitude_deg(double roll_deg, double pitch_deg, double heading_deg) {
  return core::quaternion_from({radians(roll_deg), radians(pitch_deg), radians(heading_deg)});
}

void check_same(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int i = 0; i < 3; ++i) CHECK(found[i] == Approx(expected[i]).epsilon(0.0).margin(1e-12));
}

}  // namespace

TEST_CASE("a level aircraft heading east looks east with its right hand south", "[antenna_frame]") {
  for (const bool stabilised : {true, false}) {
    const AntennaFrame frame =
        antenna_frame({1.0, 2.0, 3.0}, kNed, attitude_deg(0, 0, 90), {}, stabilised);
    check_same(frame.position_m, {1.0, 2.0, 3.0});
    check_same(frame.forward, {1.0, 0.0, 0.0});
    check_same(frame.right, {0.0, -1.0, 0.0});
    check_same(frame.up, {0.0, 0.0, 1.0});
  }
}

TEST_CASE("stabilisation removes roll and pitch and keeps heading and mounting yaw",
          "[antenna_frame]") {
  Mounting mounting;
  mounting.yaw_rad = radians(5.0);
  mounting.pitch_rad = radians(-3.0);
  mounting.roll_rad = radians(2.0);
  const AntennaFrame frame = antenna_frame({}, kNed, attitude_deg(10, -5, 30), mounting, true);
  check_same(frame.forward, {std::sin(radians(35.0)), std::cos(radians(35.0)), 0.0});
  check_same(frame.up, {0.0, 0.0, 1.0});
}

TEST_CASE("without stabilisation pitch lifts the axis and roll turns the horizon",
          "[antenna_frame]") {
  const AntennaFrame pitched = antenna_frame({}, kNed, attitude_deg(0, 5, 0), {}, false);
  check_same(pitched.forward, {0.0, std::cos(radians(5.0)), std::sin(radians(5.0))});
  // Right wing down: the right axis points below the horizon.
  const AntennaFrame rolled = antenna_frame({}, kNed, attitude_deg(10, 0, 0), {}, false);
  check_same(rolled.right, {std::cos(radians(10.0)), 0.0, -std::sin(radians(10.0))});
  // A mounting pitch adds to the aircraft's when wings are level.
  Mounting mounting;
  mounting.pitch_rad = radians(-3.0);
  const AntennaFrame mounted = antenna_frame({}, kNed, attitude_deg(0, 5, 0), mounting, false);
  check_same(mounted.forward, {0.0, std::cos(radians(2.0)), std::sin(radians(2.0))});
}

TEST_CASE("the antenna's place turns with the aircraft even when the scan is stabilised",
          "[antenna_frame]") {
  Mounting mounting;
  mounting.forward_m = 10.0;
  mounting.down_m = 2.0;
  for (const bool stabilised : {true, false}) {
    const AntennaFrame frame =
        antenna_frame({0.0, 0.0, 100.0}, kNed, attitude_deg(0, 90, 0), mounting, stabilised);
    // Nose straight up: 10 m forward is 10 m up, 2 m down is 2 m ahead, north.
    check_same(frame.position_m, {0.0, 2.0, 110.0});
  }
}

TEST_CASE("axes are orthonormal and right-handed at roll 10, pitch -5, unstabilised",
          "[antenna_frame]") {
  const AntennaFrame frame = antenna_frame({}, kNed, attitude_deg(10, -5, 264.74), {}, false);
  check_same(glm::cross(frame.forward, frame.right), -frame.up);
  CHECK(glm::length(frame.forward) == Approx(1.0).epsilon(1e-14));
  CHECK(glm::dot(frame.forward, frame.right) == Approx(0.0).epsilon(0.0).margin(1e-14));
}

TEST_CASE("angles are the inverse of direction on both scan surfaces", "[antenna_frame]") {
  const AntennaFrame frame = antenna_frame({}, kNed, attitude_deg(10, -5, 264.74), {}, false);
  for (const ScanSurface surface : {ScanSurface::plane, ScanSurface::cone}) {
    for (double azimuth_deg = -85.0; azimuth_deg <= 85.0; azimuth_deg += 8.5) {
      for (double elevation_deg = -85.0; elevation_deg <= 85.0; elevation_deg += 8.5) {
        const glm::dvec3 d =
            direction(frame, radians(azimuth_deg), radians(elevation_deg), surface);
        CHECK(glm::length(d) == Approx(1.0).epsilon(1e-14));
        const auto seen = angles(frame, 3700.0 * d, surface);
        REQUIRE(seen);
        CHECK(seen->azimuth_rad == Approx(radians(azimuth_deg)).epsilon(0.0).margin(1e-14));
        CHECK(seen->elevation_rad == Approx(radians(elevation_deg)).epsilon(0.0).margin(1e-14));
      }
    }
  }
}

TEST_CASE("the surfaces differ by 0.25 deg at the corner of HiVision's picture",
          "[antenna_frame]") {
  const AntennaFrame frame;
  const glm::dvec3 d = direction(frame, radians(20.0), radians(-8.8), ScanSurface::plane);
  // asin(cos 8.8 deg sin 20 deg) = 19.7547 deg
  CHECK(core::degrees(angles(frame, d, ScanSurface::cone)->azimuth_rad) ==
        Approx(19.7547).epsilon(0.0).margin(1e-4));
  // On the horizon and straight ahead they agree.
  CHECK(glm::distance(direction(frame, 0.3, 0.0, ScanSurface::plane),
                      direction(frame, 0.3, 0.0, ScanSurface::cone)) < 1e-15);
  CHECK(glm::distance(direction(frame, 0.0, 0.1, ScanSurface::plane),
                      direction(frame, 0.0, 0.1, ScanSurface::cone)) < 1e-15);
}

TEST_CASE("S05 points on the lateral plane, behind or at zero distance are outside",
          "[antenna_frame]") {
  const AntennaFrame frame;
  const glm::dvec3 outside[] = {{0.0, 100.0, 0.0},        {0.0, 0.0, -50.0},    {-1.0, 0.0, 0.0},
                                {-1e-300, 1.0, 0.0},      {-100.0, 5.0, 1.0},   {0.0, 0.0, 0.0},
                                {std::nan(""), 0.0, 0.0}, {kInfinity, 0.0, 0.0}};
  for (const glm::dvec3& point : outside) {
    CHECK_FALSE(angles(frame, point, ScanSurface::plane));
    CHECK_FALSE(angles(frame, point, ScanSurface::cone));
  }
  CHECK(angles(frame, {1e-300, 1.0, 0.0}, ScanSurface::plane));
}

TEST_CASE("a scan all round sees behind it, with +-180 deg in range", "[antenna_frame]") {
  const AntennaFrame frame;
  CHECK(all_round_angles(frame, {-5.0, 0.0, 0.0})->azimuth_rad == Approx(kPi).epsilon(1e-15));
  CHECK(all_round_angles(frame, {-1.0, -1.0, 0.0})->azimuth_rad ==
        Approx(radians(135.0)).epsilon(1e-15));
  CHECK_FALSE(all_round_angles(frame, {0.0, 0.0, 0.0}));
}

TEST_CASE("beams of a plane scan that reach beyond 90 deg have angles there, those of a cone none",
          "[antenna_frame]") {
  const AntennaFrame frame;
  const glm::dvec3 beside = direction(frame, radians(100.0), 0.0, ScanSurface::plane);
  Sensor sensor;
  const auto seen = [&](double field_of_view_deg, double cut_deg) {
    sensor.scan.field_of_view_rad = radians(field_of_view_deg);
    sensor.antenna.azimuth.cut_rad = radians(cut_deg);
    return angles(frame, beside, sensor);
  };
  REQUIRE(seen(150.0, 75.0));
  CHECK(seen(150.0, 75.0)->azimuth_rad == Approx(radians(100.0)).epsilon(1e-12));
  CHECK(seen(360.0, 1.0));
  CHECK_FALSE(seen(150.0, 14.0));
  sensor.scan.surface = ScanSurface::cone;
  CHECK_FALSE(seen(150.0, 75.0));
}

TEST_CASE("a beam spans the heights of its elevations, wider by the antenna's tilt, and its own",
          "[antenna_frame]") {
  Sensor sensor;
  sensor.range = {0.0, 10.0, 100};  // to 1 km
  sensor.antenna.elevation.half_power_width_rad = radians(10.0);
  sensor.antenna.elevation.cut_rad = radians(15.0);
  const auto check = [&](double boresight_deg, double tilt_deg, double low_deg, double high_deg) {
    sensor.antenna.boresight_elevation_rad = radians(boresight_deg);
    for (const bool banked : {false, true}) {
      const double roll_deg = banked ? tilt_deg : 0.0, pitch_deg = banked ? 0.0 : tilt_deg;
      const HeightSpan span = heights_in_beam(
          antenna_frame({0.0, 0.0, 50.0}, kNed, attitude_deg(roll_deg, pitch_deg, 30), {}, false),
          sensor);
      CHECK(span.lowest_m == Approx(50.0 + 1000.0 * std::sin(radians(low_deg))));
      CHECK(span.highest_m == Approx(50.0 + 1000.0 * std::sin(radians(high_deg))));
    }
  };
  check(-4.0, 0.0, -19.0, 11.0);
  check(-4.0, 20.0, -39.0, 31.0);
  check(40.0, 0.0, 0.0, 55.0);  // from the antenna up
  check(-40.0, 0.0, -55.0, 0.0);
  check(-4.0, 80.0, -90.0, 90.0);
}

TEST_CASE("an attitude that is no rotation is refused", "[antenna_frame]") {
  CHECK_THROWS_AS(antenna_frame({}, kNed, {0.0, 0.0, 0.0, 0.0}, {}, true), core::InputError);
  CHECK_THROWS_AS(antenna_frame({}, kNed, {std::nan(""), 0.0, 0.0, 0.0}, {}, true),
                  core::InputError);
  CHECK_THROWS_AS(antenna_frame({std::nan(""), 0.0, 0.0}, kNed, attitude_deg(0, 0, 0), {}, true),
                  core::InputError);
}
