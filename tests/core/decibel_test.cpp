// Hard case A07: decibels and back, with the values that have no decibel or no power.
#include "core/decibel.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.h"

using namespace fanbeam::core;

namespace {

constexpr double kFloor_dB = -400.0;

template <typename Call>
std::optional<InputError> error_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("A07 every level from -350 to 350 dB survives the round trip within 1e-10 dB", "[A07]") {
  double worst_dB = 0.0;
  for (int hundredths = -35000; hundredths <= 35000; ++hundredths) {
    const double level_dB = hundredths / 100.0;
    worst_dB =
        std::max(worst_dB, std::abs(dB_from_power(power_from_dB(level_dB), kFloor_dB) - level_dB));
  }
  CHECK(worst_dB <= 1e-10);
}

TEST_CASE("A07 known levels: 0, 3.0103 and 30 dB", "[A07]") {
  CHECK(power_from_dB(0.0) == 1.0);
  CHECK(dB_from_power(2.0, kFloor_dB) == Approx(3.0102999566398120).epsilon(1e-15));
  CHECK(power_from_dB(30.0) == Approx(1000.0).epsilon(1e-15));
}

TEST_CASE("A07 power of zero and power below the floor show as the floor, never as minus infinity",
          "[A07]") {
  CHECK(dB_from_power(0.0, -120.0) == -120.0);
  CHECK(dB_from_power(-0.0, -120.0) == -120.0);
  CHECK(dB_from_power(1e-30, -120.0) == -120.0);
}

TEST_CASE("A07 what has no power or no level is refused with its class", "[A07]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double level_dB : {4000.0, -4000.0, std::nextafter(kLargestLevel_dB, 4000.0)}) {
    const auto error = error_of([&] { power_from_dB(level_dB); });
    REQUIRE(error);
    CHECK(error->has(ErrorClass::range));
  }
  for (const double power : {-1e-30, -1.0}) {
    const auto error = error_of([&] { dB_from_power(power, kFloor_dB); });
    REQUIRE(error);
    CHECK(error->has(ErrorClass::range));
  }
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const auto level_error = error_of([&] { power_from_dB(bad); });
    const auto power_error = error_of([&] { dB_from_power(bad, kFloor_dB); });
    REQUIRE(level_error);
    REQUIRE(power_error);
    CHECK(level_error->has(ErrorClass::nonfinite));
    CHECK(power_error->has(ErrorClass::nonfinite));
  }
}

TEST_CASE("A07 the largest accepted levels stay finite and above zero", "[A07]") {
  CHECK(std::isfinite(power_from_dB(kLargestLevel_dB)));
  CHECK(power_from_dB(-kLargestLevel_dB) > 0.0);
}
