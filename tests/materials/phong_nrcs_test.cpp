#include "materials/nrcs/phong_nrcs.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "tests/materials/error_class.h"

using fanbeam::core::ErrorClass;
using fanbeam::core::radians;
using fanbeam::materials::PhongNrcs;
using fanbeam::tests::refuses;

TEST_CASE("Phong reflectivity is a + b at normal incidence and a sin + b sin^c between",
          "[materials][phong]") {
  const PhongNrcs nrcs(0.03, 0.2, 3.0);
  REQUIRE(nrcs.sigma0(1.0) == Approx(0.23).epsilon(1e-15));
  // sin(30 deg) = 1/2: 0.015 + 0.2 / 8.
  REQUIRE(nrcs.sigma0(0.5) == Approx(0.04).epsilon(1e-15));
}

TEST_CASE("Phong reflectivity of back faces, grazing and undefined angles is exactly zero",
          "[materials][phong]") {
  const PhongNrcs nrcs(0.03, 0.2, 2.0);
  for (const double sine : {0.0, -0.0, -1e-300, -0.5, -1.0, std::nan("")}) {
    INFO(sine);
    REQUIRE(nrcs.sigma0(sine) == 0.0);
  }
  REQUIRE(PhongNrcs().sigma0(1.0) == 0.0);
}

TEST_CASE("Phong reflectivity with b = 0 is the constant-gamma law to the last bit",
          "[materials][phong]") {
  const PhongNrcs nrcs(0.7, 0.0, 1.0);
  for (const double sine : {1e-300, 0.1, 0.9}) REQUIRE(nrcs.sigma0(sine) == 0.7 * sine);
}

TEST_CASE("Phong coefficients outside their ranges are refused by class", "[materials][phong]") {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  REQUIRE(refuses([] { PhongNrcs(-1e-9, 0.0, 1.0); }, ErrorClass::range));
  REQUIRE(refuses([] { PhongNrcs(0.0, -1e-9, 1.0); }, ErrorClass::range));
  REQUIRE(refuses([] { PhongNrcs(0.0, 0.0, -0.001); }, ErrorClass::range));
  REQUIRE(refuses([] { PhongNrcs(0.0, 0.0, 1001.0); }, ErrorClass::range));
  REQUIRE(refuses([nan] { PhongNrcs(nan, 0.0, 1.0); }, ErrorClass::nonfinite));
  REQUIRE(refuses([inf] { PhongNrcs(0.0, inf, 1.0); }, ErrorClass::nonfinite));
  REQUIRE(refuses([nan] { PhongNrcs(0.0, 0.0, nan); }, ErrorClass::nonfinite));
}
