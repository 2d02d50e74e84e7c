#include "core/number_range.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace fanbeam::core;

namespace {

std::string told_of(double value, const NumberRange& range) {
  ProblemList problems;
  check_range(problems, "x", value, range);
  REQUIRE(problems.all().size() == 1);
  return problems.all()[0].value;
}

}  // namespace

TEST_CASE("A value out of range is told as it was written and not as arithmetic left it",
          "[number_range]") {
  CHECK(told_of(-49.99999999999997, {-40.0, 50.0}) == "-50");  // C, by kelvin and back
  CHECK(told_of(0.1 + 0.2, {0.0, 0.25}) == "0.3");
  // All of what somebody may have written: as many digits as a double keeps.
  CHECK(told_of(1.23456789012345, {0.0, 1.0}) == "1.23456789012345");
  CHECK(told_of(123456789012345.0, {0.0, 1.0}) == number_text(123456789012345.0));
  // "1: expected 0 to 1" would tell nothing.
  CHECK(told_of(std::nextafter(1.0, 2.0), {0.0, 1.0}) == "1.0000000000000002");
}
