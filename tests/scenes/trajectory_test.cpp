#include "scenes/trajectory/trajectory.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

core::Pose pose_at(double time_s, double latitude_deg, double longitude_deg, double height_m = 0.0,
                   const core::Attitude& attitude = {}) {
  core::Pose pose;
  pose.time_s = time_s;
  pose.position = {core::radians(latitude_deg), core::radians(longitude_deg), height_m};
  pose.q_NB = core::quaternion_from(attitude);
  return pose;
}

core::Attitude heading_deg(double heading) { return {0.0, 0.0, core::radians(heading)}; }

std::string refusal_of_poses(const std::vector<core::Pose>& poses) {
  try {
    const Trajectory trajectory(poses);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("F10: a path over the date line takes the short way", "[trajectory]") {
  const Trajectory path({pose_at(0.0, 0.0, 179.999), pose_at(1.0, 0.0, -179.999)});
  const core::Geodetic half_way = path.at(0.5).position;
  CHECK(std::abs(core::degrees(half_way.longitude_rad)) == Approx(180.0).margin(1e-9).epsilon(0.0));
  CHECK(core::degrees(half_way.latitude_rad) == Approx(0.0).epsilon(0.0).margin(1e-9));
  // 0.002 deg of the equator, a = 6378137 m.
  CHECK(terrain::geodesic_between(path.at(0.0).position, half_way).length_m +
            terrain::geodesic_between(half_way, path.at(1.0).position).length_m ==
        Approx(222.639).margin(1e-3).epsilon(0.0));
}

TEST_CASE("F10: a path over the pole crosses it", "[trajectory]") {
  const Trajectory path({pose_at(0.0, 89.9, 0.0, 500.0, heading_deg(0.0)),
                         pose_at(1.0, 89.9, 180.0, 700.0, heading_deg(180.0))});
  const core::Pose half_way = path.at(0.5);
  CHECK(core::degrees(half_way.position.latitude_rad) == Approx(90.0).margin(1e-9).epsilon(0.0));
  CHECK(half_way.position.height_m == Approx(600.0));
}

TEST_CASE("An aircraft that flies straight on over the pole keeps its nose ahead", "[trajectory]") {
  const Trajectory path({pose_at(0.0, 89.9, 0.0, 0.0, heading_deg(0.0)),
                         pose_at(1.0, 89.9, 180.0, 0.0, heading_deg(180.0))});
  // Heading jumps from 0 to 180 at the pole; slerp of the north-east-down attitudes would turn the
  // nose through 90 deg.
  CHECK(core::degrees(core::attitude_from(path.at(0.25).q_NB).heading_rad) ==
        Approx(0.0).epsilon(0.0).margin(1e-6));
  CHECK(core::degrees(core::attitude_from(path.at(0.75).q_NB).heading_rad) ==
        Approx(180.0).epsilon(0.0).margin(1e-6));
}

TEST_CASE("Heading is interpolated through north", "[trajectory]") {
  const Trajectory path({pose_at(0.0, 47.0, 11.0, 0.0, heading_deg(359.0)),
                         pose_at(2.0, 47.0, 11.0, 0.0, heading_deg(3.0))});
  CHECK(core::degrees(core::attitude_from(path.at(1.0).q_NB).heading_rad) ==
        Approx(1.0).epsilon(0.0).margin(1e-9));
}

TEST_CASE("S01 half way between two poses the nose goes the short way through north and south",
          "[trajectory]") {
  const auto half_way_deg = [](double from_deg, double to_deg) {
    const Trajectory path({pose_at(0.0, 47.0, 11.0, 0.0, heading_deg(from_deg)),
                           pose_at(2.0, 47.0, 11.0, 0.0, heading_deg(to_deg))});
    return core::degrees(core::attitude_from(path.at(1.0).q_NB).heading_rad);
  };
  const double through_north_deg = half_way_deg(359.9, 0.1);
  CHECK(std::min(through_north_deg, 360.0 - through_north_deg) <= 1e-9);
  CHECK(through_north_deg >= 0.0);
  CHECK(through_north_deg < 360.0);
  CHECK(std::abs(half_way_deg(179.9, -179.9) - 180.0) <= 1e-9);
}

TEST_CASE("The chord's sag is not in the height", "[trajectory]") {
  // 10 km apart: the chord is 2 m below the arc in the middle.
  const core::Geodetic first{core::radians(47.0), core::radians(11.0), 800.0};
  core::Pose begin;
  core::Pose end;
  begin.position = first;
  end.position = terrain::geodesic_point(first, core::radians(70.0), 10e3);
  end.time_s = 100.0;
  const Trajectory path({begin, end});
  const core::Geodetic third = path.at(100.0 / 3.0).position;
  CHECK(third.height_m == Approx(800.0).epsilon(0.0).margin(1e-9));
  // Documented: d^3 / (60 Re^2) = 0.41 mm, of which a third of the way has nearly all.
  const core::Geodetic on_geodesic =
      terrain::geodesic_point(first, core::radians(70.0), 10e3 / 3.0);
  CHECK(terrain::geodesic_between(third, on_geodesic).length_m < 0.42e-3);
}

TEST_CASE("Stored poses come back unchanged, and times outside are refused", "[trajectory]") {
  const std::vector<core::Pose> poses = {pose_at(1.0, 47.0, 11.0, 5.0, heading_deg(10.0)),
                                         pose_at(2.0, 47.1, 11.0, 6.0, heading_deg(20.0)),
                                         pose_at(4.0, 47.2, 11.0, 7.0, heading_deg(30.0))};
  const Trajectory path(poses);
  for (const core::Pose& pose : poses) {
    CHECK(path.at(pose.time_s).position.latitude_rad == pose.position.latitude_rad);
    CHECK(path.at(pose.time_s).q_NB == pose.q_NB);
  }
  CHECK_THROWS_WITH(path.at(0.999), Catch::Contains("E-TIME") && Catch::Contains("1 to 4 s"));
  CHECK_THROWS_WITH(path.at(4.001), Catch::Contains("E-TIME"));
  CHECK_THROWS_WITH(path.at(std::numeric_limits<double>::quiet_NaN()),
                    Catch::Contains("E-NONFINITE"));
}

TEST_CASE("One pose holds at any time and gives one frame", "[trajectory]") {
  const Trajectory fixed({pose_at(5.0, 47.0, 11.0, 600.0, heading_deg(90.0))});
  CHECK(fixed.at(-1e6).position.height_m == 600.0);
  CHECK(fixed.at(fixed.frame_time_s(0, 16.0)).time_s == 5.0 + 0.5 / 16.0);
  CHECK(fixed.frame_count(16.0) == 1);
}

TEST_CASE("S09: frame times of a day do not drift", "[trajectory]") {
  const double begin_s = GENERATE(0.0, 1738784101.87);
  const Trajectory day({pose_at(begin_s, 47.0, 11.0), pose_at(begin_s + 86400.0, 47.0, 11.5)});
  const double rate_Hz = GENERATE(10.0, 16.0);
  const int frames = static_cast<int>(86400.0 * rate_Hz);
  REQUIRE(day.frame_count(rate_Hz) == frames);
  // The catalogue asks for 1e-9 s; a Unix time itself is rounded to 2.4e-7 s.
  const double tolerance_s = begin_s == 0.0 ? 1e-9 : 2.4e-7;
  double largest_error_s = 0.0;
  for (int k = 0; k < frames; ++k) {
    // The exact time in extended precision.
    const long double rate = static_cast<long double>(rate_Hz);
    const long double exact_s = static_cast<long double>(begin_s) + (k + 0.5L) / rate;
    const auto time_s = static_cast<long double>(day.frame_time_s(k, rate_Hz));
    largest_error_s = std::max(largest_error_s, static_cast<double>(std::abs(time_s - exact_s)));
  }
  CHECK(largest_error_s <= tolerance_s);
  CHECK(day.frame_time_s(frames - 1, rate_Hz) < day.end_s());
}

TEST_CASE("Frames are those that end before the trajectory does", "[trajectory]") {
  const Trajectory path({pose_at(0.0, 47.0, 11.0), pose_at(1.03, 47.0, 11.001)});
  CHECK(path.frame_count(16.0) == 16);
  CHECK(path.frame_count(0.5) == 0);
  CHECK_THROWS_WITH(path.frame_count(0.0), Catch::Contains("E-RANGE"));
  CHECK_THROWS_WITH(path.frame_time_s(0, std::numeric_limits<double>::infinity()),
                    Catch::Contains("E-NONFINITE"));
  const Trajectory long_path({pose_at(0.0, 47.0, 11.0), pose_at(1e5, 47.0, 11.001)});
  CHECK_THROWS_WITH(long_path.frame_count(1e6), Catch::Contains("E-LIMIT"));
}

TEST_CASE("Every impossible pose is named", "[trajectory]") {
  CHECK_THAT(refusal_of_poses({}), Catch::Contains("E-RANGE"));
  CHECK_THAT(refusal_of_poses({pose_at(0.0, 47.0, 11.0), pose_at(0.0, 47.0, 11.0)}),
             Catch::Contains("E-TIME pose 1"));
  CHECK_THAT(refusal_of_poses({pose_at(0.0, 91.0, 11.0), pose_at(1.0, 47.0, 600.0)}),
             Catch::Contains("E-RANGE pose 0.latitude_deg") &&
                 Catch::Contains("E-RANGE pose 1.longitude_deg"));
  CHECK_THAT(refusal_of_poses({pose_at(0.0, 0.0, 0.0), pose_at(1.0, 0.0, 180.0)}),
             Catch::Contains("E-RANGE pose 1 distance"));
  core::Pose unturned = pose_at(0.0, 47.0, 11.0);
  unturned.q_NB = {0.0, 0.0, 0.0, 0.0};
  CHECK_THAT(refusal_of_poses({unturned}), Catch::Contains("E-RANGE pose 0 attitude"));
  core::Pose lost = pose_at(0.0, 47.0, 11.0);
  lost.v_N_mps.y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal_of_poses({lost}), Catch::Contains("E-NONFINITE pose 0"));
}

}  // namespace fanbeam::scenes
