#include "scenes/trajectory/ils_approach.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory_transplant.h"

namespace fanbeam::scenes {
namespace {

// Braunschweig 26: 87.8 m above the sea, the geoid 44 m above the ellipsoid.
IlsApproach braunschweig() {
  IlsApproach approach;
  approach.threshold = {core::radians(52.320297), core::radians(10.575681), 131.8};
  approach.runway_bearing_rad = core::radians(264.74);
  approach.glide_path_rad = core::radians(3.5);
  approach.end = ApproachEnd::full_stop;
  return approach;
}

IlsApproach innsbruck() {
  IlsApproach approach;
  approach.threshold = {core::radians(47.2616005), core::radians(11.3570004), 625.0};
  approach.runway_bearing_rad = core::radians(261.04);
  approach.localiser_course_rad = core::radians(256.0);
  approach.crossing_distance_m = 2500.0;
  return approach;
}

terrain::LocalFrame frame_at(const IlsApproach& approach,
                             terrain::EarthModel model = terrain::EarthModel::wgs84) {
  return terrain::LocalFrame(approach.threshold, model);
}

Trajectory fly(const IlsApproach& approach) {
  return fly_ils_approach(approach, frame_at(approach));
}

RunwayEnd runway_of(const IlsApproach& approach) {
  return {approach.threshold, approach.runway_bearing_rad};
}

std::string refusal(const IlsApproach& approach) {
  try {
    fly(approach);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

double roll_deg(const core::Pose& pose) {
  return core::degrees(core::attitude_from(pose.q_NB).roll_rad);
}
double pitch_deg(const core::Pose& pose) {
  return core::degrees(core::attitude_from(pose.q_NB).pitch_rad);
}
double heading_deg(const core::Pose& pose) {
  return core::degrees(core::attitude_from(pose.q_NB).heading_rad);
}

}  // namespace

TEST_CASE("The glide path is a straight line in space through the crossing height", "[ils]") {
  IlsApproach approach = braunschweig();
  approach.start_distance_m = 30e3;
  const terrain::LocalFrame frame = frame_at(approach);
  const Trajectory flight = fly_ils_approach(approach, frame);
  // In the tangent plane at the threshold, where a height above the ellipsoid would be 70 m off at
  // 30 km.
  for (const core::Pose& pose : flight.poses()) {
    const RunwayRelative relative = relative_to(runway_of(approach), pose.position);
    if (relative.before_threshold_m < 50.0) break;
    const glm::dvec3 local_m = frame.to_local_m(pose.position);
    const double line_m = 15.0 + std::hypot(local_m.x, local_m.y) * std::tan(core::radians(3.5));
    REQUIRE(local_m.z == Approx(line_m).margin(2e-3).epsilon(0.0));
    REQUIRE(relative.right_m == Approx(0.0).epsilon(0.0).margin(1e-5));
  }
}

TEST_CASE("On a plane Earth the path is straight in the scene's frame", "[ils]") {
  const IlsApproach approach = braunschweig();
  // The scene's origin lies elsewhere.
  const terrain::LocalFrame frame({core::radians(52.35), core::radians(10.5), 90.0},
                                  terrain::EarthModel::plane);
  const Trajectory flight = fly_ils_approach(approach, frame);
  const glm::dvec3 threshold_m = frame.to_local_m(approach.threshold);
  const glm::dvec3 ahead =
      frame.north_east_down_at(approach.threshold) *
      glm::dvec3{std::cos(approach.runway_bearing_rad), std::sin(approach.runway_bearing_rad), 0.0};
  for (const core::Pose& pose : flight.poses()) {
    const glm::dvec3 from_m = frame.to_local_m(pose.position) - threshold_m;
    const double to_go_m = -glm::dot(from_m, ahead);
    if (to_go_m < 50.0) break;
    REQUIRE(from_m.z ==
            Approx(15.0 + to_go_m * std::tan(core::radians(3.5))).epsilon(0.0).margin(1e-6));
    REQUIRE(glm::length(glm::cross(from_m + to_go_m * ahead, glm::dvec3(0, 0, 1))) < 1e-6);
    // Headings are true: they turn with the meridians, the nose does not.
    const double heading_rad = core::radians(heading_deg(pose));
    const glm::dvec3 nose = frame.north_east_down_at(pose.position) *
                            glm::dvec3{std::cos(heading_rad), std::sin(heading_rad), 0.0};
    REQUIRE(glm::distance(nose, ahead) < 2e-7);
  }
}

TEST_CASE("Flare and roll-out: height and sink rate are continuous", "[ils]") {
  IlsApproach approach = braunschweig();
  approach.runway_slope = 0.002;
  const Trajectory flight = fly(approach);
  const std::vector<core::Pose>& poses = flight.poses();
  double touchdown_sink_mps = 0.0;
  double largest_load_mps2 = 0.0;
  bool rolling = false;
  for (std::size_t i = 2; i + 2 < poses.size(); ++i) {
    const RunwayRelative relative = relative_to(runway_of(approach), poses[i].position);
    const double runway_m = -relative.before_threshold_m * 0.002;
    const double wheels_m = relative.height_m - runway_m - 3.0;
    REQUIRE(wheels_m > -1e-6);
    const double sink_mps = poses[i].v_N_mps.z + 0.002 * glm::length(poses[i].v_N_mps);
    if (wheels_m > 0.02) {
      // Not across touchdown, where the wheels stop the sinking.
      if (wheels_m > 0.1)
        largest_load_mps2 = std::max(largest_load_mps2,
                                     std::abs(poses[i + 1].v_N_mps.z - poses[i].v_N_mps.z) / 0.02);
      touchdown_sink_mps = sink_mps;
      REQUIRE_FALSE(rolling);
    } else if (wheels_m < 1e-6) {
      rolling = true;
    }
  }
  CHECK(rolling);
  CHECK(touchdown_sink_mps == Approx(0.6).epsilon(0.0).margin(0.05));
  // (4.42 + 0.6) m/s shed within 2 * 12 m / (4.42 + 0.6 m/s) = 4.8 s.
  CHECK(largest_load_mps2 < 0.9);
  CHECK(glm::length(poses[poses.size() - 2].v_N_mps) < 0.1);
  CHECK(pitch_deg(poses.back()) ==
        Approx(core::degrees(std::atan(0.002))).epsilon(0.0).margin(1e-6));
}

// Lukla 06 (VNLK): 527 m long and 62.45 m higher at its far end, 11.85 %, flown by a STOL aircraft
// with 78 kt.
TEST_CASE("A landing uphill on Lukla's slope touches down and stops on the runway", "[ils]") {
  constexpr double kSlope = 62.45 / 527.0;
  IlsApproach approach;
  approach.threshold = {core::radians(27.6869), core::radians(86.7278), 2750.0};
  approach.runway_bearing_rad = core::radians(60.0);
  approach.runway_slope = kSlope;
  approach.glide_path_rad = core::radians(5.0);
  approach.threshold_crossing_height_m = 10.0;
  approach.start_distance_m = 2000.0;
  approach.speed_mps = 40.0;
  approach.flare_height_m = 5.0;
  approach.rollout_deceleration_mps2 = 3.0;
  approach.end = ApproachEnd::full_stop;
  const Trajectory flight = fly(approach);
  double on_runway_m = 0.0, pitch_at_touchdown_deg = 0.0;
  bool rolling = false;
  for (const core::Pose& pose : flight.poses()) {
    const RunwayRelative relative = relative_to(runway_of(approach), pose.position);
    on_runway_m = -relative.before_threshold_m;
    const double wheels_m = relative.height_m - kSlope * on_runway_m - 3.0;
    REQUIRE(wheels_m > -1e-6);
    if (wheels_m < 1e-6 && !rolling) {
      rolling = true;
      pitch_at_touchdown_deg = pitch_deg(pose);
      // 7 m over the threshold, less a flare of 2 h / (s1 + s2): -9.7 m - 45.3 m.
      CHECK(on_runway_m == Approx(55.0).epsilon(0.0).margin(1.0));
    }
  }
  CHECK(rolling);
  const double runway_deg = core::degrees(std::atan(kSlope));
  CHECK(pitch_at_touchdown_deg == Approx(runway_deg + 5.0).epsilon(0.0).margin(0.01));
  CHECK(pitch_deg(flight.poses().back()) == Approx(runway_deg).epsilon(0.0).margin(1e-6));
  // 40 m/s, or what is left of it after touchdown, shed at 3 m/s^2: 267 m.
  CHECK(on_runway_m == Approx(55.0 + 267.0).epsilon(0.0).margin(3.0));
  approach.runway_slope = 0.21;
  CHECK(refusal(approach).find("runway_slope") != std::string::npos);
}

TEST_CASE("The stop is where the deceleration puts it", "[ils]") {
  IlsApproach approach = braunschweig();
  const Trajectory whole = fly(approach);
  approach.end = ApproachEnd::touchdown;
  const Trajectory landed = fly(approach);
  const double roll_m =
      terrain::geodesic_between(landed.poses().back().position, whole.poses().back().position)
          .length_m;
  // v^2 / 2a, and up to one step before touchdown.
  CHECK(roll_m == Approx(70.0 * 70.0 / (2.0 * 1.8)).epsilon(0.0).margin(1.5));
  approach.end = ApproachEnd::decision_height;
  const Trajectory decided = fly(approach);
  const double height_m =
      relative_to(runway_of(approach), decided.poses().back().position).height_m;
  CHECK(height_m == Approx(200.0 * 0.3048).epsilon(0.0).margin(0.1));
}

TEST_CASE("On a rising runway the decision height still counts from the threshold", "[ils]") {
  IlsApproach approach = braunschweig();
  approach.glide_path_rad = core::radians(3.0);
  approach.runway_slope = 0.02;
  approach.decision_height_m = 60.96;
  approach.end = ApproachEnd::decision_height;
  const terrain::LocalFrame frame = frame_at(approach, terrain::EarthModel::plane);
  const Trajectory decided = fly_ils_approach(approach, frame);
  const glm::dvec3 last_m =
      frame.to_local_m(decided.poses().back().position) - frame.to_local_m(approach.threshold);
  // (60.96 - 15) / tan 3 deg, and up to one step before it.
  CHECK(std::hypot(last_m.x, last_m.y) == Approx(877.0).epsilon(0.0).margin(1.5));
  CHECK(last_m.z == Approx(60.96).epsilon(0.0).margin(0.1));
}

TEST_CASE("An offset localiser is followed to where it meets the centre line", "[ils]") {
  const IlsApproach approach = innsbruck();
  const Trajectory flight = fly(approach);
  const double offset_rad = core::radians(256.0 - 261.04);
  double largest_bank_deg = 0.0;
  bool on_centre_line = false;
  for (const core::Pose& pose : flight.poses()) {
    const RunwayRelative at = relative_to(runway_of(approach), pose.position);
    largest_bank_deg = std::max(largest_bank_deg, std::abs(roll_deg(pose)));
    if (at.before_threshold_m > 2800.0) {
      // The localiser's line, 5.04 deg off, through the centre line 2500 m out.
      REQUIRE(at.right_m == Approx(-(at.before_threshold_m - 2500.0) * std::tan(offset_rad))
                                .epsilon(0.0)
                                .margin(0.01));
      REQUIRE(heading_deg(pose) == Approx(256.0).epsilon(0.0).margin(0.1));
    }
    if (at.before_threshold_m < 2300.0) {
      on_centre_line = true;
      REQUIRE(std::abs(at.right_m) < 1e-4);
      REQUIRE(heading_deg(pose) == Approx(261.04).epsilon(0.0).margin(0.05));
    }
  }
  CHECK(on_centre_line);
  CHECK(largest_bank_deg == Approx(15.0).epsilon(0.0).margin(0.1));
}

TEST_CASE("By default the turn lies where the glide path has the decision height", "[ils]") {
  IlsApproach approach = innsbruck();
  approach.crossing_distance_m.reset();
  approach.decision_height_m = 90.0;
  const Trajectory flight = fly(approach);
  // (90 - 15) / tan 3 deg = 1431 m: half a turn's length before it the aircraft leaves the beam.
  const auto turning = std::max_element(
      flight.poses().begin(), flight.poses().end(),
      [](const core::Pose& a, const core::Pose& b) { return roll_deg(a) < roll_deg(b); });
  CHECK(relative_to(runway_of(approach), turning->position).before_threshold_m ==
        Approx(1431.0).epsilon(0.0).margin(5.0));
}

TEST_CASE("Wind makes crab and changes ground speed", "[ils]") {
  IlsApproach approach = braunschweig();
  approach.end = ApproachEnd::touchdown;
  approach.wind_speed_mps = 10.0;
  approach.wind_from_rad = core::radians(264.74 + 90.0);  // from the right
  const Trajectory crossed = fly(approach);
  const core::Pose early = crossed.at(30.0);
  // asin(10 / 70) = 8.213 deg into the wind, ground speed 70 cos of it = 69.282 m/s.
  CHECK(heading_deg(early) ==
        Approx(264.74 + 8.213).epsilon(0.0).margin(0.12));  // meridians: 0.1 deg at 8 km
  CHECK(std::hypot(early.v_N_mps.x, early.v_N_mps.y) == Approx(69.282).epsilon(0.0).margin(0.01));
  CHECK(heading_deg(crossed.poses().back()) == Approx(264.74).epsilon(0.0).margin(0.02));

  approach.wind_from_rad = approach.runway_bearing_rad;  // head wind
  const core::Pose headed = fly(approach).at(30.0);
  CHECK(std::hypot(headed.v_N_mps.x, headed.v_N_mps.y) == Approx(60.0).epsilon(0.0).margin(0.01));
  // Through the air the path is flatter: atan(60 tan 3.5 / 70) = 3.001 deg, plus 4 deg.
  CHECK(pitch_deg(headed) ==
        Approx(4.0 - 3.001).epsilon(0.0).margin(0.08));  // the beam's angle grows by s / R

  approach.speed_kind = SpeedKind::ground;
  const core::Pose asked = fly(approach).at(30.0);
  CHECK(std::hypot(asked.v_N_mps.x, asked.v_N_mps.y) == Approx(70.0).epsilon(0.0).margin(0.01));
}

TEST_CASE("Turbulence shakes the approach, repeats with its seed and ends calm", "[ils]") {
  IlsApproach approach = braunschweig();
  const Trajectory calm = fly(approach);
  approach.turbulence_wind_20ft_mps = 15.0;
  const Trajectory rough = fly(approach);
  const Trajectory again = fly(approach);
  approach.seed = 2;
  const Trajectory other = fly(approach);
  REQUIRE(rough.poses().size() == calm.poses().size());
  double largest_m = 0.0;
  double largest_deg = 0.0;
  for (std::size_t i = 0; i < calm.poses().size(); ++i) {
    const RunwayRelative is = relative_to(runway_of(approach), rough.poses()[i].position);
    const RunwayRelative was = relative_to(runway_of(approach), calm.poses()[i].position);
    largest_m = std::max(
        {largest_m, std::abs(is.right_m - was.right_m), std::abs(is.height_m - was.height_m)});
    largest_deg = std::max(largest_deg, std::abs(roll_deg(rough.poses()[i])));
    REQUIRE(rough.poses()[i].position.height_m == again.poses()[i].position.height_m);
    REQUIRE(is.height_m > 2.9);
  }
  CHECK(rough.poses()[2000].position.height_m != other.poses()[2000].position.height_m);
  // Moderate turbulence (30 kt at 20 ft): metres and degrees, not tens of them.
  CHECK(largest_m > 1.0);
  CHECK(largest_m < 20.0);
  CHECK(largest_deg > 0.5);
  CHECK(largest_deg < 8.0);
  CHECK(rough.poses().back().position.height_m == calm.poses().back().position.height_m);
}

TEST_CASE("An impossible approach is refused with every reason", "[ils]") {
  IlsApproach approach = braunschweig();
  approach.glide_path_rad = core::radians(0.5);
  approach.speed_mps = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(approach),
             Catch::Contains("E-RANGE glide_path_deg") && Catch::Contains("E-NONFINITE speed_mps"));
  approach = braunschweig();
  approach.wind_speed_mps = 39.0;
  approach.speed_mps = 40.0;
  CHECK_THAT(refusal(approach), Catch::Contains("E-RANGE wind_speed_mps"));
  approach = braunschweig();
  approach.start_distance_m = 500.0;
  CHECK_THAT(refusal(approach), Catch::Contains("E-RANGE start_distance_m"));
  approach = innsbruck();
  approach.crossing_distance_m = 100.0;
  CHECK_THAT(refusal(approach), Catch::Contains("E-RANGE crossing_distance_m"));
  approach = innsbruck();
  approach.localiser_course_rad = core::radians(200.0);
  CHECK_THAT(refusal(approach), Catch::Contains("E-RANGE localiser_course_deg"));
  approach = braunschweig();
  approach.speed_mps = 20.0;
  approach.touchdown_sink_mps = 2.5;
  CHECK_THAT(refusal(approach), Catch::Contains("E-RANGE touchdown_sink_mps"));
}

}  // namespace fanbeam::scenes
