// Series for vector loops, against the standard library over their stated ranges.
#include "core/series.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/constants.h"

namespace fanbeam::core {
namespace {

constexpr int kPlaces = 200000;

TEST_CASE("Cosine and sine by series are within 1e-9 to a right angle, exact near 0",
          "[core][series]") {
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const double angle_rad = kPi / 2 * i / kPlaces;
    double cosine = 0.0, sine = 0.0;
    series_cosine_sine(angle_rad, cosine, sine);
    const double bound = std::abs(angle_rad) < 0.3 ? 1e-15 : 1e-9;
    REQUIRE(std::abs(cosine - std::cos(angle_rad)) < bound);
    REQUIRE(std::abs(sine - std::sin(angle_rad)) < bound);
  }
}

TEST_CASE("Arc tangent by series is within 2e-10 in the right half-plane, exact near the axes",
          "[core][series]") {
  CHECK(series_arctangent(0.0, 0.0) == 0.0);
  CHECK(series_arctangent(1.0, 0.0) == kPi / 2);
  CHECK(series_arctangent(-1e300, 1e-300) == -kPi / 2);
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const double angle_rad = kPi / 2 * i / kPlaces;
    const double length = std::exp(20.0 * std::sin(i));
    const double y = length * std::sin(angle_rad), x = length * std::cos(angle_rad);
    const double from_axis_rad = std::min(std::abs(angle_rad), kPi / 2 - std::abs(angle_rad));
    const double bound = from_axis_rad < 0.45 ? 1e-15 : 2e-10;
    REQUIRE(std::abs(series_arctangent(y, x) - std::atan2(y, x)) < bound);
  }
}

TEST_CASE("Arcsine by series is within 3e-8 from 0 to 1, and 0 of 0", "[core][series]") {
  CHECK(series_arcsine(0.0) == 0.0);
  for (int i = 1; i <= kPlaces; ++i) {
    const double sine = static_cast<double>(i) / kPlaces;
    REQUIRE(std::abs(series_arcsine(sine) - std::asin(sine)) < 3e-8);
  }
}

TEST_CASE("Decay by series is within 3e-10 relative over all magnitudes, exactly 1 at 0",
          "[core][series]") {
  CHECK(series_decay(0.0) == 1.0);
  for (int i = 0; i <= kPlaces; ++i) {
    const double x = 700.0 * i / kPlaces;
    REQUIRE(std::abs(series_decay(x) / std::exp(-x) - 1.0) < 3e-10);
  }
  CHECK(series_decay(1e300) < 1e-303);
  CHECK(series_decay(1e300) > 0.0);
}

TEST_CASE("Logarithm by series is within 1e-15 relative from the smallest normal number up",
          "[core][series]") {
  CHECK(series_log(1.0) == 0.0);
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    // Close to 1, where the result is small and cancellation would show, and over all magnitudes.
    const double near_one = 1.0 + 0.4 * i / kPlaces;
    if (i != 0) REQUIRE(series_log(near_one) == Approx(std::log(near_one)).epsilon(1e-15));
    const double far = std::exp(708.0 * i / kPlaces);
    if (i != 0) REQUIRE(series_log(far) == Approx(std::log(far)).epsilon(1e-15).margin(1e-15));
  }
  CHECK(series_log(0.0) < -708.0);
  CHECK(series_log(std::numeric_limits<double>::denorm_min()) < -708.0);
  CHECK(series_log(std::numeric_limits<double>::infinity()) > 709.0);
}

}  // namespace
}  // namespace fanbeam::core
