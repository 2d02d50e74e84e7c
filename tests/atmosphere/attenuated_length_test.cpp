#include "atmosphere/attenuated_length.h"

#include <limits>

#include "tests/atmosphere/within.h"

using namespace fanbeam;
using atmosphere::attenuated_length_m;

TEST_CASE("A04 vanishing attenuation", "[attenuated_length][A04]") {
  constexpr double kLength_m = 3.0;
  CHECK(attenuated_length_m(0.0, kLength_m) == 3.0);
  CHECK(attenuated_length_m(std::numeric_limits<double>::denorm_min(), kLength_m) == 3.0);
  for (const double a : {1e-18, 1e-12, 1e-6}) {
    // Series of (1 - exp(-x)) / x with x = 2 a L <= 6e-6: the next term is below 1e-17.
    const double x = 2.0 * a * kLength_m;
    CHECK(attenuated_length_m(a, kLength_m) ==
          tests::within(kLength_m * (1.0 - x / 2.0 + x * x / 6.0), 1e-14));
  }
}

TEST_CASE("Attenuated length tends to 1 / (2 a) on long paths", "[attenuated_length]") {
  CHECK(attenuated_length_m(0.5, 1e4) == tests::within(1.0, 1e-15));
  CHECK(attenuated_length_m(0.5, 1.0) == tests::within(1.0 - std::exp(-1.0), 1e-15));
  CHECK(attenuated_length_m(1e300, 1e300) == 0.0);
  CHECK(attenuated_length_m(0.5, 0.0) == 0.0);
}
