#include "scenes/trajectory/trajectory_transplant.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

core::Geodetic geodetic_deg(double latitude_deg, double longitude_deg, double height_m) {
  return {core::radians(latitude_deg), core::radians(longitude_deg), height_m};
}

// Denver 26 and Innsbruck 26.
const RunwayEnd kDenver{geodetic_deg(39.8772011, -104.6190033, 1612.7), core::radians(270.69)};
const RunwayEnd kInnsbruck{geodetic_deg(47.2616005, 11.3570004, 577.3 + 47.6),
                           core::radians(261.04)};

// On the centre line of Denver's runway and beside it, heading 2 deg right of the runway.
Trajectory denver_flight() {
  std::vector<core::Pose> poses;
  for (int i = 0; i <= 30; ++i) {
    core::Pose pose;
    pose.time_s = 100.0 + 7.0 * i;
    const double to_go_m = 15000.0 - 500.0 * i;
    pose.position = position_from(kDenver, {to_go_m, 10.0 * i, 15.0 + 0.05 * to_go_m});
    pose.q_NB = core::quaternion_from(
        {core::radians(3.0), core::radians(1.0), kDenver.bearing_rad + core::radians(2.0)});
    pose.v_N_mps = {0.0, -70.0, 3.5};
    poses.push_back(pose);
  }
  Trajectory flight(poses);
  flight.attitude_derived = true;
  return flight;
}

}  // namespace

TEST_CASE("Runway coordinates: before, right, above", "[trajectory_transplant]") {
  const core::Geodetic before =
      terrain::geodesic_point(kInnsbruck.threshold, kInnsbruck.bearing_rad + core::kPi, 2000.0);
  const RunwayRelative on_axis = relative_to(kInnsbruck, before);
  CHECK(on_axis.before_threshold_m == Approx(2000.0).epsilon(1e-9));
  CHECK(on_axis.right_m == Approx(0.0).epsilon(0.0).margin(1e-6));
  const core::Geodetic right =
      terrain::geodesic_point(kInnsbruck.threshold, kInnsbruck.bearing_rad + core::kPi / 2, 30.0);
  CHECK(relative_to(kInnsbruck, right).right_m == Approx(30.0).epsilon(1e-9));
  // A pilot landing to the west has north on the right.
  CHECK(right.latitude_rad > kInnsbruck.threshold.latitude_rad);
  const RunwayRelative relative{5000.0, -120.0, 250.0};
  const RunwayRelative back = relative_to(kInnsbruck, position_from(kInnsbruck, relative));
  CHECK(back.before_threshold_m == Approx(5000.0).epsilon(1e-9));
  CHECK(back.right_m == Approx(-120.0).epsilon(1e-6));
  CHECK(back.height_m == Approx(250.0).epsilon(1e-9));
}

TEST_CASE("A transplanted flight is the same seen from the new runway", "[trajectory_transplant]") {
  const Trajectory flight = denver_flight();
  const Trajectory moved = transplant(flight, kDenver, kInnsbruck, -100.0);
  REQUIRE(moved.poses().size() == flight.poses().size());
  CHECK(moved.begin_s() == 0.0);
  CHECK(moved.attitude_derived);
  for (std::size_t i = 0; i < flight.poses().size(); ++i) {
    const RunwayRelative was = relative_to(kDenver, flight.poses()[i].position);
    const RunwayRelative is = relative_to(kInnsbruck, moved.poses()[i].position);
    CHECK(is.before_threshold_m == Approx(was.before_threshold_m).epsilon(0.0).margin(1e-6));
    CHECK(is.right_m == Approx(was.right_m).epsilon(0.0).margin(1e-6));
    CHECK(is.height_m == Approx(was.height_m).epsilon(0.0).margin(1e-9));
    CHECK(glm::length(moved.poses()[i].v_N_mps) ==
          Approx(glm::length(flight.poses()[i].v_N_mps)).epsilon(1e-12));
    const core::Attitude attitude = core::attitude_from(moved.poses()[i].q_NB);
    CHECK(core::degrees(attitude.roll_rad) == Approx(3.0).epsilon(1e-9));
    CHECK(core::degrees(attitude.pitch_rad) == Approx(1.0).epsilon(1e-9));
  }
  // At the threshold the heading is that of the runway plus 2 deg. Farther out meridians converge,
  // at Innsbruck otherwise than at Denver: 0.13 deg times 15 km.
  CHECK(core::degrees(core::attitude_from(moved.poses().back().q_NB).heading_rad) ==
        Approx(263.04).epsilon(0.0).margin(0.01));
  CHECK(core::degrees(core::attitude_from(moved.poses().front().q_NB).heading_rad) ==
        Approx(263.04).epsilon(0.0).margin(0.2));
}

TEST_CASE("Moving there and back changes nothing", "[trajectory_transplant]") {
  const Trajectory flight = denver_flight();
  const Trajectory back = transplant(transplant(flight, kDenver, kInnsbruck), kInnsbruck, kDenver);
  for (std::size_t i = 0; i < flight.poses().size(); ++i) {
    const core::Pose& was = flight.poses()[i];
    const core::Pose& is = back.poses()[i];
    CHECK(terrain::geodesic_between(was.position, is.position).length_m < 1e-6);
    CHECK(std::abs(glm::dot(was.q_NB, is.q_NB)) == Approx(1.0).epsilon(1e-12));
  }
}

TEST_CASE("A pose exactly on the threshold turns with the runway", "[trajectory_transplant]") {
  core::Pose pose;
  pose.position = kDenver.threshold;
  pose.q_NB = core::quaternion_from({0.0, 0.0, kDenver.bearing_rad});
  const Trajectory moved = transplant(Trajectory({pose}), kDenver, kInnsbruck);
  CHECK(core::degrees(core::attitude_from(moved.poses()[0].q_NB).heading_rad) ==
        Approx(261.04).epsilon(1e-9));
}

TEST_CASE("A flight to another airport is refused", "[trajectory_transplant]") {
  CHECK_THROWS_WITH(transplant(denver_flight(), kInnsbruck, kDenver), Catch::Contains("E-RANGE"));
  RunwayEnd nowhere = kDenver;
  nowhere.bearing_rad = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(transplant(denver_flight(), nowhere, kDenver),
                    Catch::Contains("E-NONFINITE from.bearing"));
  CHECK_THROWS_WITH(
      transplant(denver_flight(), kDenver, kDenver, std::numeric_limits<double>::infinity()),
      Catch::Contains("E-NONFINITE"));
}

}  // namespace fanbeam::scenes
