#include "terrain/local_frame.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/random.h"
#include "core/units.h"

namespace fanbeam::terrain {
namespace {

core::Geodetic geodetic_deg(double latitude_deg, double longitude_deg, double height_m) {
  return {core::radians(latitude_deg), core::radians(longitude_deg), height_m};
}

const core::Geodetic kInnsbruck = geodetic_deg(47.26, 11.34, 581.0);

std::string problem_of(const core::Geodetic& position) {
  try {
    check_geodetic(position, "sensor");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Distance in metres between a position and its image after geodetic -> ECEF -> geodetic -> ECEF.
double round_trip_error_m(const core::Geodetic& position) {
  const glm::dvec3 ecef_m = ecef_from_geodetic(position);
  const core::Geodetic back = geodetic_from_ecef(ecef_m);
  const double height_error_m = std::abs(back.height_m - position.height_m);
  return std::max(glm::distance(ecef_from_geodetic(back), ecef_m), height_error_m);
}

}  // namespace

TEST_CASE("T03: the Earth curves away below the tangent plane", "[local_frame]") {
  const LocalFrame frame(kInnsbruck);
  struct Row {
    double distance_m, east_m, up_m;
  };
  for (const Row& row : {Row{1000.0, 1000.0909, -0.0783}, Row{5000.0, 5000.4541, -1.9565},
                         Row{10000.0, 10000.9052, -7.8258}}) {
    const glm::dvec3 local_m =
        frame.to_local_m(geodesic_point(kInnsbruck, core::radians(90.0), row.distance_m));
    CHECK(local_m.x == Approx(row.east_m).margin(1e-3).epsilon(0.0));
    CHECK(local_m.z == Approx(row.up_m).margin(1e-3).epsilon(0.0));
  }
}

TEST_CASE("T04: a million positions survive the round trip", "[local_frame]") {
  constexpr std::uint64_t kPoints = 1'000'000;
  const core::RandomKey key{4, core::kStreamTerrain, 0};
  double largest_error_m = 0.0;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const auto words = core::random_words(key, i, 0);
    const core::Geodetic position{std::asin(2.0 * core::uniform_from(words[0]) - 1.0),
                                  core::kPi * (2.0 * core::uniform_from(words[1]) - 1.0),
                                  20.0e3 * (2.0 * core::uniform_from(words[2]) - 1.0)};
    largest_error_m = std::max(largest_error_m, round_trip_error_m(position));
  }
  for (const double latitude_deg : {-90.0, 0.0, 90.0})
    for (const double longitude_deg : {-180.0, 0.0, 180.0})
      largest_error_m = std::max(
          largest_error_m, round_trip_error_m(geodetic_deg(latitude_deg, longitude_deg, 0.0)));
  INFO("largest error " << largest_error_m << " m");
  CHECK(largest_error_m < 2e-8);
}

TEST_CASE("T05: a frame at the pole and one on the date line", "[local_frame]") {
  const LocalFrame pole(geodetic_deg(90.0, 30.0, 0.0));
  const glm::dvec3 near_pole_m = pole.to_local_m(geodetic_deg(89.999, 120.0, 10.0));
  CHECK(std::abs(near_pole_m.x - 111.694154) < 1e-5);
  CHECK(std::abs(near_pole_m.y) < 1e-5);
  CHECK(std::abs(near_pole_m.z - 9.999025) < 1e-5);

  for (const EarthModel model : {EarthModel::wgs84, EarthModel::plane}) {
    const LocalFrame date_line(geodetic_deg(0.0, 180.0, 0.0), model);
    for (const double longitude_deg : {-179.999, 180.001, 540.001})
      CHECK(std::abs(date_line.to_local_m(geodetic_deg(0.0, longitude_deg, 0.0)).x - 111.319491) <
            1e-5);
  }
}

TEST_CASE("T06: coordinates outside their domain are refused by name", "[local_frame]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  using Catch::Matchers::Contains;
  CHECK_THAT(problem_of(geodetic_deg(90.0000001, 0.0, 0.0)),
             Contains("E-RANGE sensor.latitude_deg"));
  CHECK_THAT(problem_of(geodetic_deg(-91.0, 0.0, 0.0)), Contains("E-RANGE sensor.latitude_deg"));
  CHECK_THAT(problem_of(geodetic_deg(nan, 0.0, 0.0)), Contains("E-NONFINITE sensor.latitude_deg"));
  CHECK_THAT(problem_of(geodetic_deg(0.0, infinity, 0.0)),
             Contains("E-NONFINITE sensor.longitude_deg"));
  CHECK_THAT(problem_of({0.0, 1e300, 0.0}), Contains("E-RANGE sensor.longitude_deg"));
  CHECK_THAT(problem_of(geodetic_deg(0.0, 0.0, 1e9)), Contains("E-RANGE sensor.height_m"));
  CHECK_THAT(problem_of(geodetic_deg(0.0, 0.0, nan)), Contains("E-NONFINITE sensor.height_m"));

  CHECK(problem_of(geodetic_deg(90.0, 540.0, 1.0e6)) == "accepted");
  CHECK(problem_of(geodetic_deg(-90.0, -540.0, -20.0e3)) == "accepted");
  CHECK_THROWS_AS(LocalFrame(geodetic_deg(-91.0, 0.0, 0.0)), core::InputError);
  CHECK_THROWS_AS(LocalFrame(geodetic_deg(-91.0, 0.0, 0.0), EarthModel::plane), core::InputError);
}

TEST_CASE("A frame and its inverse agree, on the ellipsoid and on a plane Earth", "[local_frame]") {
  for (const EarthModel model : {EarthModel::wgs84, EarthModel::plane}) {
    const LocalFrame frame(kInnsbruck, model);
    const glm::dvec3 local_m{-12345.6, 7890.1, 234.5};
    CHECK(glm::distance(frame.to_local_m(frame.to_geodetic(local_m)), local_m) < 2e-8);
    CHECK(glm::length(frame.to_local_m(kInnsbruck)) < 2e-8);
  }
}

// A map of degrees of latitude and longitude has no east at the poles and a seam at the date line.
const std::vector<core::Geodetic> kOrigins{
    kInnsbruck,
    geodetic_deg(0.0, 180.0, 0.0),
    geodetic_deg(52.0, -180.0, 50.0),
    geodetic_deg(89.95, 123.0, 2000.0),
    geodetic_deg(90.0, 0.0, 0.0),
    geodetic_deg(90.0, 77.0, 0.0),
    geodetic_deg(-90.0, -45.0, 2835.0),
};

TEST_CASE(
    "T05: a plane Earth is the same at a pole and across the date line: geodesics keep length and "
    "direction",
    "[local_frame]") {
  for (const core::Geodetic& origin : kOrigins) {
    INFO(core::degrees(origin.latitude_rad) << ", " << core::degrees(origin.longitude_rad));
    const LocalFrame frame(origin, EarthModel::plane);
    for (double azimuth_deg = -170.0; azimuth_deg <= 180.0; azimuth_deg += 10.0)
      for (const double distance_m : {0.5, 3700.0, 12345.6}) {
        const double azimuth_rad = core::radians(azimuth_deg);
        core::Geodetic there = geodesic_point(origin, azimuth_rad, distance_m);
        there.height_m = origin.height_m + 234.5;
        const glm::dvec3 local_m = frame.to_local_m(there);
        const glm::dvec3 expected_m{distance_m * std::sin(azimuth_rad),
                                    distance_m * std::cos(azimuth_rad), 234.5};
        REQUIRE(glm::distance(local_m, expected_m) < 1e-7);
        REQUIRE(glm::distance(frame.to_local_m(frame.to_geodetic(local_m)), local_m) < 1e-7);
      }
  }
}

TEST_CASE("A plane Earth has the places and the north of the round one, but for its curvature",
          "[local_frame]") {
  constexpr double kRadius_m = 6335.4e3;  // the smallest of WGS 84
  for (const core::Geodetic& origin : kOrigins) {
    INFO(core::degrees(origin.latitude_rad) << ", " << core::degrees(origin.longitude_rad));
    const LocalFrame plane(origin, EarthModel::plane);
    const LocalFrame round(origin);
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 15.0)
      for (const double distance_m : {100.0, 3700.0, 10.0e3}) {
        core::Geodetic there = geodesic_point(origin, core::radians(azimuth_deg), distance_m);
        there.height_m = origin.height_m;
        const glm::dvec3 difference_m = plane.to_local_m(there) - round.to_local_m(there);
        // d^3 / (6 R^2) of foreshortening, and heights of the origin stretch the round one.
        const double level_m = std::pow(distance_m, 3) / (6.0 * kRadius_m * kRadius_m) +
                               distance_m * std::abs(origin.height_m) / kRadius_m;
        REQUIRE(std::hypot(difference_m.x, difference_m.y) < 1.01 * level_m + 1e-6);
        REQUIRE(difference_m.z == Approx(0.5 * distance_m * distance_m / kRadius_m).epsilon(0.012));
        // The plumb line tilts by d / R; north turns about it alike.
        const glm::dmat3 a = plane.north_east_down_at(there);
        const glm::dmat3 b = round.north_east_down_at(there);
        const double tilt = distance_m / kRadius_m;
        for (int axis = 0; axis < 3; ++axis)
          REQUIRE(glm::distance(a[axis], b[axis]) < 1.01 * tilt + 1e-9);
        for (int axis = 0; axis < 2; ++axis)
          REQUIRE(std::hypot(a[axis].x - b[axis].x, a[axis].y - b[axis].y) < tilt * tilt + 1e-9);
      }
  }
}

TEST_CASE("On a plane Earth what lies on the origin's meridian is due north or south exactly",
          "[local_frame]") {
  const LocalFrame frame(geodetic_deg(52.0, 10.0, 50.0), EarthModel::plane);
  for (const double latitude_deg : {51.9, 51.99999, 52.0, 52.00001, 52.1}) {
    const core::Geodetic there = geodetic_deg(latitude_deg, 10.0, 50.0);
    CHECK(frame.to_local_m(there).x == 0.0);
    const glm::dmat3 level = frame.north_east_down_at(there);
    CHECK(level[0] == glm::dvec3(0.0, 1.0, 0.0));
    CHECK(level[1] == glm::dvec3(1.0, 0.0, 0.0));
    CHECK(level[2] == glm::dvec3(0.0, 0.0, -1.0));
  }
}

TEST_CASE("North, east and down are those of the place asked for", "[local_frame]") {
  const LocalFrame frame(kInnsbruck);
  const core::Geodetic place = geodesic_point(kInnsbruck, core::radians(90.0), 10.0e3);
  const glm::dmat3 axes = frame.north_east_down_at(place);
  const glm::dvec3 here_m = frame.to_local_m(place);
  core::Geodetic higher = place;
  higher.height_m += 100.0;
  core::Geodetic further_north = place;
  further_north.latitude_rad += 1e-9;
  CHECK(glm::distance(-axes[2], (frame.to_local_m(higher) - here_m) / 100.0) < 1e-9);
  // 6.4 mm of arc against positions rounded to about 1e-9 m.
  const glm::dvec3 north = glm::normalize(frame.to_local_m(further_north) - here_m);
  CHECK(glm::distance(axes[0], north) < 1e-6);
  CHECK(glm::distance(glm::cross(axes[0], axes[1]), axes[2]) < 1e-14);
  // 10 km over an Earth radius of 6388 km tilts the plumb line by 1.565 mrad.
  CHECK(std::asin(-axes[2].x) == Approx(10.0e3 / 6388.5e3).epsilon(1e-3));
}

TEST_CASE("F10: geodesics cross the date line and the pole", "[local_frame]") {
  const core::Geodetic west = geodetic_deg(0.0, 179.999, 0.0);
  const GeodesicLine line = geodesic_between(west, geodetic_deg(0.0, -179.999, 0.0));
  CHECK(std::abs(line.length_m - 222.639) < 1e-3);
  const core::Geodetic half_way = geodesic_point(west, line.azimuth_rad, 0.5 * line.length_m);
  CHECK(std::abs(std::abs(core::degrees(half_way.longitude_rad)) - 180.0) < 1e-9);

  const core::Geodetic before_pole = geodetic_deg(89.9, 0.0, 0.0);
  const GeodesicLine over = geodesic_between(before_pole, geodetic_deg(89.9, 180.0, 0.0));
  const core::Geodetic top = geodesic_point(before_pole, over.azimuth_rad, 0.5 * over.length_m);
  CHECK(std::abs(core::degrees(top.latitude_rad) - 90.0) < 1e-9);
}

}  // namespace fanbeam::terrain
