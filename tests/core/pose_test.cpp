// Hard cases S01 to S03: attitudes through north, at the poles of the Euler angles, and nearly
// equal ones.
#include "core/pose.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

#include "core/errors.h"
#include "core/units.h"

using namespace fanbeam::core;

namespace {

glm::dquat heading_quaternion(double heading_deg) {
  return quaternion_from({0.0, 0.0, radians(heading_deg)});
}

double half_way_heading_deg(double from_deg, double to_deg) {
  const glm::dquat q = interpolate(heading_quaternion(from_deg), heading_quaternion(to_deg), 0.5);
  return degrees(attitude_from(q).heading_rad);
}

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0.0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
  return largest;
}

double norm(const glm::dquat& q) {
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}

// The rotation written as a product of the three elementary ones, independent of the quaternion
// formula.
glm::dmat3 matrix_from_elementary_turns(double roll_deg, double pitch_deg, double heading_deg) {
  const double r = radians(roll_deg), p = radians(pitch_deg), h = radians(heading_deg);
  const glm::dmat3 about_x(1, 0, 0, 0, std::cos(r), std::sin(r), 0, -std::sin(r), std::cos(r));
  const glm::dmat3 about_y(std::cos(p), 0, -std::sin(p), 0, 1, 0, std::sin(p), 0, std::cos(p));
  const glm::dmat3 about_z(std::cos(h), std::sin(h), 0, -std::sin(h), std::cos(h), 0, 0, 0, 1);
  return about_z * about_y * about_x;
}

}  // namespace

TEST_CASE("S01 half way between headings goes the short way through north and south", "[S01]") {
  const double through_north_deg = half_way_heading_deg(359.9, 0.1);
  CHECK(std::min(through_north_deg, 360.0 - through_north_deg) <= 1e-9);
  CHECK(through_north_deg >= 0.0);
  CHECK(through_north_deg < 360.0);
  CHECK(half_way_heading_deg(179.9, -179.9) == Approx(180.0).epsilon(0.0).margin(1e-9));
  CHECK(half_way_heading_deg(80.0, 100.0) == Approx(90.0).epsilon(0.0).margin(1e-9));
}

TEST_CASE("Attitude angles turn the body the way an aircraft's do", "[pose]") {
  // Nose up points the forward axis above the horizon, that is to negative down.
  const glm::dvec3 forward =
      quaternion_from({0.0, radians(10.0), radians(90.0)}) * glm::dvec3(1, 0, 0);
  CHECK(forward.x == Approx(0.0).epsilon(0.0).margin(1e-15));
  CHECK(forward.y == Approx(std::cos(radians(10.0))));
  CHECK(forward.z == Approx(-std::sin(radians(10.0))));
  // Right wing down points the right axis below the horizon.
  const glm::dvec3 right = quaternion_from({radians(30.0), 0.0, 0.0}) * glm::dvec3(0, 1, 0);
  CHECK(right.z == Approx(0.5));
}

TEST_CASE("Angles survive the quaternion wherever they are unique", "[pose]") {
  for (int roll_deg = -170; roll_deg <= 170; roll_deg += 17)
    for (int pitch_deg = -85; pitch_deg <= 85; pitch_deg += 17)
      for (int heading_deg = 0; heading_deg < 360; heading_deg += 24) {
        const Attitude back = attitude_from(
            quaternion_from({radians(roll_deg), radians(pitch_deg), radians(heading_deg)}));
        CHECK(degrees(back.roll_rad) == Approx(roll_deg).epsilon(0.0).margin(1e-9));
        CHECK(degrees(back.pitch_rad) == Approx(pitch_deg).epsilon(0.0).margin(1e-9));
        CHECK(degrees(wrap_pi_rad(back.heading_rad - radians(heading_deg))) ==
              Approx(0.0).epsilon(0.0).margin(1e-9));
      }
}

TEST_CASE("S02 straight up and straight down: the rotation survives quaternion and Euler angles",
          "[S02]") {
  for (const double pitch_deg : {90.0, -90.0})
    for (int roll_deg = 0; roll_deg < 360; roll_deg += 30)
      for (int heading_deg = 0; heading_deg < 360; heading_deg += 30) {
        const glm::dquat q =
            quaternion_from({radians(roll_deg), radians(pitch_deg), radians(heading_deg)});
        const glm::dmat3 matrix = glm::mat3_cast(q);
        INFO("pitch " << pitch_deg << " roll " << roll_deg << " heading " << heading_deg);
        CHECK(largest_difference(glm::transpose(matrix) * matrix, glm::dmat3(1.0)) <= 1e-12);
        CHECK(glm::determinant(matrix) == Approx(1.0).epsilon(0.0).margin(1e-12));
        CHECK(largest_difference(
                  matrix, matrix_from_elementary_turns(roll_deg, pitch_deg, heading_deg)) <= 1e-12);

        const Attitude attitude = attitude_from(q);
        CHECK(attitude.roll_rad == 0.0);
        CHECK(degrees(attitude.pitch_rad) == Approx(pitch_deg).epsilon(0.0).margin(1e-6));
        CHECK(largest_difference(matrix, glm::mat3_cast(quaternion_from(attitude))) <= 1e-12);
      }
}

TEST_CASE("S03 nearly equal, opposite and perpendicular quaternions interpolate to unit length",
          "[S03]") {
  const glm::dquat a = quaternion_from({0.1, 0.2, 0.3});
  const glm::dquat minus_a{-a.w, -a.x, -a.y, -a.z};
  const glm::dquat perpendicular{-a.x, a.w, -a.z, a.y};
  const glm::dquat longer{a.w * (1 + 1e-16) + 1e-16, a.x, a.y, a.z};
  const glm::dquat shorter{a.w - 1.2e-16, a.x, a.y, a.z};
  for (const glm::dquat& b : {a, minus_a, perpendicular, longer, shorter})
    for (const double s : {0.0, 0.25, 0.5, 1.0})
      CHECK(norm(interpolate(a, b, s)) == Approx(1.0).epsilon(0.0).margin(1e-12));
}

TEST_CASE("S03 the same attitude with the opposite sign means no motion", "[S03]") {
  const glm::dquat a = quaternion_from({0.1, 0.2, 0.3});
  const glm::dquat minus_a{-a.w, -a.x, -a.y, -a.z};
  for (const double s : {0.0, 0.3, 0.5, 1.0})
    CHECK(largest_difference(glm::mat3_cast(interpolate(a, minus_a, s)), glm::mat3_cast(a)) <=
          1e-12);
}

TEST_CASE("S03 interpolation turns at a constant rate, on both sides of its switch of formula",
          "[S03]") {
  for (const double turn_deg : {170.0, 10.0, 0.01, 0.0017, 0.0015, 1e-6}) {
    const glm::dquat a = heading_quaternion(40.0), b = heading_quaternion(40.0 + turn_deg);
    for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double heading_deg = degrees(attitude_from(interpolate(a, b, s)).heading_rad);
      CHECK(heading_deg == Approx(40.0 + s * turn_deg).epsilon(0.0).margin(1e-12 * 180.0));
    }
  }
}

TEST_CASE("S03 a zero or non-finite quaternion is refused", "[S03]") {
  const glm::dquat a(1.0, 0.0, 0.0, 0.0);
  const auto class_of = [&](const glm::dquat& bad) {
    try {
      interpolate(a, bad, 0.5);
    } catch (const InputError& error) {
      return error.problems().at(0).code;
    }
    return std::string("accepted");
  };
  CHECK(class_of({0.0, 0.0, 0.0, 0.0}) == "E-RANGE");
  CHECK(class_of({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0}) == "E-NONFINITE");
  CHECK(class_of({std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0}) == "E-NONFINITE");
}
