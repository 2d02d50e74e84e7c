// G05: phase unwrapping.
#include "signal/fourier/unwrap.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/constants.h"

using namespace fanbeam;
using core::kPi;
using signal::unwrapped;

namespace {

std::vector<double> wrapped_ramp(double step_rad, int count) {
  std::vector<double> phases;
  for (int i = 0; i < count; ++i) phases.push_back(std::remainder(step_rad * i, 2.0 * kPi));
  return phases;
}

}  // namespace

TEST_CASE("G05 steps below pi are recovered, in both directions", "[unwrap]") {
  for (const double step_rad : {0.1, 3.0, 3.1415, -0.1, -3.0, -3.1415}) {
    const auto phases = unwrapped(wrapped_ramp(step_rad, 1000));
    for (int i = 0; i < 1000; ++i)
      REQUIRE(phases[static_cast<std::size_t>(i)] ==
              Approx(step_rad * i).margin(1e-9).epsilon(0.0));
  }
}

TEST_CASE("G05 a step of exactly pi counts as +pi", "[unwrap]") {
  for (const double sign : {1.0, -1.0}) {
    const auto phases = unwrapped(wrapped_ramp(sign * kPi, 1000));
    for (int i = 0; i < 1000; ++i)
      REQUIRE(phases[static_cast<std::size_t>(i)] == Approx(kPi * i).margin(1e-9).epsilon(0.0));
  }
  CHECK(unwrapped({0.0, -kPi})[1] == Approx(kPi).margin(1e-9).epsilon(0.0));
}

TEST_CASE("G05 the result differs from the input by whole turns", "[unwrap]") {
  std::vector<double> phases;
  for (int i = 0; i < 500; ++i) phases.push_back(100.0 * std::sin(1.7 * i));
  const auto result = unwrapped(phases);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double turns = (result[i] - phases[i]) / (2.0 * kPi);
    REQUIRE(turns == Approx(std::round(turns)).margin(1e-9).epsilon(0.0));
    if (i > 0) REQUIRE(std::abs(result[i] - result[i - 1]) <= kPi + 1e-9);
  }
}

TEST_CASE("G05 what is not a number makes a gap, and the rest stays finite", "[unwrap]") {
  auto phases = wrapped_ramp(0.5, 100);
  phases[40] = std::numeric_limits<double>::quiet_NaN();
  phases[41] = std::numeric_limits<double>::infinity();
  const auto result = unwrapped(phases);
  for (int i = 0; i < 100; ++i) {
    const double found = result[static_cast<std::size_t>(i)];
    if (i == 40 || i == 41)
      CHECK(std::isnan(found));
    else
      CHECK(found == Approx(0.5 * i).margin(1e-9).epsilon(0.0));
  }
  CHECK(unwrapped({}).empty());
}
