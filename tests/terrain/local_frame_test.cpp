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
  CHECK_THROWS_AS(LocalFrame(geodetic_deg(90.0, 0.0, 0.0), EarthModel::plane), core::InputError);
}

TEST_CASE("A frame and its inverse agree, on the ellipsoid and on a plane Earth", "[local_frame]") {
  for (const EarthModel model : {EarthModel::wgs84, EarthModel::plane}) {
    const LocalFrame frame(kInnsbruck, model);
    const glm::dvec3 local_m{-12345.6, 7890.1, 234.5};
    CHECK(glm::distance(frame.to_local_m(frame.to_geodetic(local_m)), local_m) < 2e-8);
    CHECK(glm::length(frame.to_local_m(kInnsbruck)) < 2e-8);
  }
}

TEST_CASE("A plane Earth has no curvature and arcs of the right length", "[local_frame]") {
  const LocalFrame frame(kInnsbruck, EarthModel::plane);
  const glm::dvec3 east_m =
      frame.to_local_m(geodesic_point(kInnsbruck, core::radians(90.0), 1000.0));
  const glm::dvec3 north_m = frame.to_local_m(geodesic_point(kInnsbruck, 0.0, 1000.0));
  CHECK(east_m.z == 0.0);
  CHECK(std::abs(east_m.x - 1000.0) < 1e-2);   // the parallel bends away from the geodesic
  CHECK(std::abs(north_m.y - 1000.0) < 1e-3);  // the meridian's radius grows with latitude
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

  const glm::dmat3 level = LocalFrame(kInnsbruck, EarthModel::plane).north_east_down_at(place);
  CHECK(level[0] == glm::dvec3(0.0, 1.0, 0.0));
  CHECK(level[1] == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(level[2] == glm::dvec3(0.0, 0.0, -1.0));
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
