#include "materials/dielectric/fresnel.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/constants.h"
#include "core/units.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::kPi;
using tests::refuses;

TEST_CASE("M03 no boundary reflects nothing at any angle, grazing included", "[materials][M03]") {
  for (const double incidence_rad : {0.0, 0.3, 1.0, 1.5, kPi / 2.0}) {
    const FresnelReflection gamma = fresnel_reflection({1.0, 0.0}, incidence_rad);
    REQUIRE(std::abs(gamma.horizontal) == 0.0);
    REQUIRE(std::abs(gamma.vertical) == 0.0);
  }
}

TEST_CASE("M03 vertical reflection vanishes at Brewster's angle", "[materials][M03]") {
  REQUIRE(std::abs(fresnel_reflection({4.0, 0.0}, std::atan(2.0)).vertical) < 1e-12);
  // tan^2 of Brewster's angle is eps.
  for (const double eps : {1.0001, 2.5, 9.0, 80.0})
    REQUIRE(std::abs(fresnel_reflection({eps, 0.0}, std::atan(std::sqrt(eps))).vertical) < 1e-12);
}

TEST_CASE("M03 everything reflects fully at 90 degrees", "[materials][M03]") {
  for (const Permittivity& eps : {Permittivity{4.0, 0.0}, Permittivity{1.001, 0.0},
                                  Permittivity{19.56, 29.41}, Permittivity{1.0, 5e6}}) {
    const FresnelReflection gamma = fresnel_reflection(eps, kPi / 2.0);
    INFO(eps.real << " - j " << eps.loss);
    REQUIRE(std::abs(std::abs(gamma.horizontal) - 1.0) < 1e-12);
    REQUIRE(std::abs(std::abs(gamma.vertical) - 1.0) < 1e-12);
  }
}

TEST_CASE("M04 a passive lossy medium never reflects more than it receives", "[materials][M04]") {
  std::mt19937_64 generator(4);
  std::uniform_real_distribution<double> real(1.0, 100.0);
  std::uniform_real_distribution<double> loss(0.0, 100.0);
  std::uniform_real_distribution<double> incidence_rad(0.0, kPi / 2.0);
  double largest = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const FresnelReflection gamma =
        fresnel_reflection({real(generator), loss(generator)}, incidence_rad(generator));
    largest = std::max({largest, std::abs(gamma.horizontal), std::abs(gamma.vertical)});
  }
  REQUIRE(largest <= 1.0 + 1e-12);
  REQUIRE(largest > 0.99);
}

TEST_CASE("M04 gain instead of loss, and permittivity below that of vacuum, are refused",
          "[materials][M04]") {
  REQUIRE(refuses([] { fresnel_reflection({5.0, -0.1}, 0.5); }, ErrorClass::range));
  REQUIRE(refuses([] { fresnel_reflection({0.5, 0.1}, 0.5); }, ErrorClass::range));
  REQUIRE(refuses([] { fresnel_reflection({std::nan(""), 0.1}, 0.5); }, ErrorClass::nonfinite));
  REQUIRE(refuses([] { fresnel_reflection({5.0, 0.1}, 1.6); }, ErrorClass::range));
  REQUIRE(refuses([] { fresnel_reflection({5.0, 0.1}, -0.1); }, ErrorClass::range));
}

TEST_CASE("Fresnel coefficients equal the textbook quotient where that is well conditioned",
          "[materials][fresnel]") {
  const Permittivity permittivity{10.8, 19.8};
  const std::complex<double> eps = permittivity.complex();
  for (const double incidence_deg : {0.0, 20.0, 45.0, 70.0, 85.0}) {
    const double t = core::radians(incidence_deg);
    const std::complex<double> q = std::sqrt(eps - std::sin(t) * std::sin(t));
    const FresnelReflection gamma = fresnel_reflection(permittivity, t);
    REQUIRE(std::abs(gamma.horizontal - (std::cos(t) - q) / (std::cos(t) + q)) < 1e-14);
    REQUIRE(std::abs(gamma.vertical - (eps * std::cos(t) - q) / (eps * std::cos(t) + q)) < 1e-14);
  }
}

TEST_CASE("Fresnel signs: opposite at normal incidence, and glass reflects 4 percent",
          "[materials][fresnel]") {
  const FresnelReflection gamma = fresnel_reflection({2.25, 0.0}, 0.0);
  REQUIRE(gamma.vertical.real() == Approx(0.2).epsilon(1e-14));
  REQUIRE(gamma.horizontal.real() == Approx(-0.2).epsilon(1e-14));
  REQUIRE(normal_reflectivity({2.25, 0.0}) == Approx(0.04).epsilon(1e-14));
}

}  // namespace
}  // namespace fanbeam::materials
