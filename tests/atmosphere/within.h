// Relative comparison of computed with published values.
#pragma once

#include <catch2/catch.hpp>

namespace fanbeam::tests {

// Where the expected value is 0 the result must be 0 too.
inline Approx within(double expected, double relative) {
  return Approx(expected).epsilon(relative).scale(0.0).margin(0.0);
}

}  // namespace fanbeam::tests
