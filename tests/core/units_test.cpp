#include "core/units.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fanbeam::core;

TEST_CASE("Aviation units are the exact international ones", "[units]") {
  CHECK(kFoot_m == 0.3048);
  CHECK(kKnot_mps * 3600.0 == Approx(1852.0).epsilon(0.0).margin(1e-12));
}

TEST_CASE("Degrees and radians agree at the cardinal angles and back", "[units]") {
  CHECK(radians(180.0) == kPi);
  CHECK(degrees(kPi / 2.0) == Approx(90.0).epsilon(0.0).margin(1e-13));
  for (double angle_deg = -720.0; angle_deg <= 720.0; angle_deg += 7.3)
    CHECK(degrees(radians(angle_deg)) == Approx(angle_deg).epsilon(0.0).margin(1e-12));
}

TEST_CASE("rounded_degrees gives back the degrees of a file, and no -0", "[units]") {
  for (int tenths = -3600; tenths <= 3600; ++tenths)
    CHECK(rounded_degrees(radians(tenths / 10.0)) == tenths / 10.0);
  CHECK_FALSE(std::signbit(rounded_degrees(-1e-12)));
}

TEST_CASE("wrap_360_deg stays inside the half-open circle, also just below zero", "[units]") {
  CHECK(wrap_360_deg(0.0) == 0.0);
  CHECK(wrap_360_deg(360.0) == 0.0);
  CHECK(wrap_360_deg(-90.0) == 270.0);
  CHECK(wrap_360_deg(725.0) == 5.0);
  // -1e-20 + 360 rounds to 360, which is outside.
  CHECK(wrap_360_deg(-1e-20) < 360.0);
  CHECK(wrap_360_deg(-1e-20) >= 0.0);
}

TEST_CASE("wrap_pi_rad keeps the angle and stays within half a turn", "[units]") {
  for (double angle_rad = -20.0; angle_rad <= 20.0; angle_rad += 0.37) {
    const double wrapped_rad = wrap_pi_rad(angle_rad);
    const double turns = (angle_rad - wrapped_rad) / (2.0 * kPi);
    CHECK(std::abs(wrapped_rad) <= kPi);
    CHECK(turns == Approx(std::round(turns)).epsilon(0.0).margin(1e-12));
  }
}
