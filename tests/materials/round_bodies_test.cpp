// Sphere and wire: exact series against their limits and published values.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "materials/rcs/rcs.h"
#include "materials/rcs/round_wire.h"
#include "materials/rcs/sphere.h"
#include "tests/decibel.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::kPi;
using core::radians;
using tests::dB;

// sigma / (pi a^2) of a sphere.
double relative_sphere(double ka) {
  const double lambda_m = 2.0 * kPi / ka;  // radius 1 m
  return sphere_rcs_m2(1.0, lambda_m) / kPi;
}

TEST_CASE("A small sphere follows Rayleigh's (ka)^4", "[materials][rcs]") {
  for (const double ka : {1e-6, 1e-3, 0.01, 0.03})
    CHECK(relative_sphere(ka) == Approx(9.0 * std::pow(ka, 4)).epsilon(2.0 * ka * ka + 1e-9));
}

TEST_CASE("A sphere of ka = 1.03 is the brightest, 3.65 times its disc", "[materials][rcs]") {
  // The first maximum of the resonance region in every textbook: 3.65 near ka = 1.03.
  double largest = 0.0;
  double at = 0.0;
  for (double ka = 0.3; ka < 3.0; ka += 0.001)
    if (relative_sphere(ka) > largest) {
      largest = relative_sphere(ka);
      at = ka;
    }
  CHECK(largest == Approx(3.655).epsilon(0.0).margin(0.001));
  CHECK(at == Approx(1.028).epsilon(0.0).margin(0.002));
}

TEST_CASE(
    "A large sphere returns its disc: within 0.62 dB from ka = 10, 0.04 dB where the series "
    "is left",
    "[materials][rcs]") {
  double beyond_10 = 0.0;
  double beyond_40 = 0.0;
  for (double ka = 10.0; ka < 50.0; ka += 0.01) {
    const double off_dB = std::abs(dB(relative_sphere(ka)));
    beyond_10 = std::max(beyond_10, off_dB);
    if (ka > 45.0) beyond_40 = std::max(beyond_40, off_dB);
  }
  CHECK(beyond_10 < 0.62);
  CHECK(beyond_40 < 0.05);
  CHECK(relative_sphere(50.001) == Approx(1.0).epsilon(1e-14));
  CHECK(relative_sphere(1e9) == Approx(1.0).epsilon(1e-14));
}

// Broadside, relative to geometrical optics 2 pi a L^2 / lambda.
double relative_wire(double ka, double polarisation_rad) {
  const double lambda_m = 2.0 * kPi / ka;  // radius 1 m
  const double length_m = 1e3;
  return round_wire_rcs_m2(1.0, length_m, polarisation_rad, 0.0, lambda_m) /
         (2.0 * kPi * length_m * length_m / lambda_m);
}

TEST_CASE("A thick wire is the cylinder of geometrical optics in both polarisations",
          "[materials][rcs]") {
  for (const double ka : {7.33, 20.0, 49.9, 50.1, 300.0}) {
    INFO(ka);
    const double bound_dB = ka < 10.0 ? 0.3 : ka < 40.0 ? 0.05 : 0.006;
    CHECK(std::abs(dB(relative_wire(ka, 0.0))) < bound_dB);
    CHECK(std::abs(dB(relative_wire(ka, kPi / 2.0))) < bound_dB);
    CHECK(std::abs(dB(relative_wire(ka, kPi / 4.0))) < bound_dB);
  }
  const double lambda_m = core::kSpeedOfLight_mps / 35e9;
  for (const double sine : {0.0, 0.003, 0.01, 0.05}) {
    const glm::dvec3 direction(std::sqrt(1.0 - sine * sine), 0.0, sine);
    CHECK(rcs_m2(RoundWire{0.3, 2.0}, direction, lambda_m) ==
          Approx(rcs_m2(Cylinder{0.3, 2.0}, direction, lambda_m)).epsilon(1e-9));
  }
}

TEST_CASE("A thin wire is Chu's along the field and vanishes across it", "[materials][rcs]") {
  for (const double ka : {1e-4, 1e-3, 0.01, 0.05}) {
    INFO(ka);
    const double lambda_m = 2.0 * kPi / ka;
    const double log = std::log(lambda_m / (1.781072418 * kPi));
    const double chu_m2 = kPi * 1e6 / (kPi * kPi / 4.0 + log * log);
    const double exact_m2 = round_wire_rcs_m2(1.0, 1e3, 0.0, 0.0, lambda_m);
    CHECK(std::abs(dB(exact_m2 / chu_m2)) < 0.1);
    // Rayleigh scattering of a thin cylinder, field across: |V| = 3 pi (ka)^2 / 4.
    CHECK(round_wire_rcs_m2(1.0, 1e3, kPi / 2.0, 0.0, lambda_m) ==
          Approx(4e6 / kPi * std::pow(0.75 * kPi * ka * ka, 2)).epsilon(0.01));
    // Obliquely to the field only its part along the wire counts, going and coming: cos^4.
    CHECK(round_wire_rcs_m2(1.0, 1e3, radians(60.0), 0.0, lambda_m) ==
          Approx(exact_m2 / 16.0).epsilon(0.002 + 30.0 * ka * ka));
  }
}

TEST_CASE("The thin-wire formula must not be used for a 20 mm wire at 35 GHz", "[materials][rcs]") {
  const double lambda_m = core::kSpeedOfLight_mps / 35e9;
  const double exact_m2 = round_wire_rcs_m2(0.01, 1.0, 0.0, 0.0, lambda_m);
  CHECK(2.0 * kPi * 0.01 / lambda_m == Approx(7.335).epsilon(0.0).margin(1e-3));
  CHECK(std::abs(dB(exact_m2 / (2.0 * kPi * 0.01 / lambda_m))) < 0.05);
  const double log = std::log(lambda_m / (1.781072418 * kPi * 0.01));
  CHECK(dB(kPi / (kPi * kPi / 4.0 + log * log) / exact_m2) < -10.0);
}

// Twice its broadside was told: thin wires lean so far across the field that T and V cancel there, and not off it.
TEST_CASE("No wire sends more than the largest that is told of it", "[materials][rcs]") {
  double tightest = 1e300;
  for (double ka = 0.01; ka < 80.0; ka *= 1.17) {
    const double lambda_m = 2.0 * kPi / ka;  // radius 1 m
    for (double polarisation_deg = 0.0; polarisation_deg <= 90.0; polarisation_deg += 1.0)
      for (const double kl : {0.5, 30.0}) {
        INFO("ka " << ka << ", kL " << kl << ", field at " << polarisation_deg << " deg");
        const RoundWire wire{1.0, kl / ka, radians(polarisation_deg)};
        const double most_m2 = largest_rcs_m2(wire, lambda_m);
        double sent_m2 = 0.0;
        for (double e_deg = 0.0; e_deg < 90.0; e_deg += 3.0)
          sent_m2 = std::max(
              sent_m2,
              rcs_m2(wire, {std::cos(radians(e_deg)), 0.0, std::sin(radians(e_deg))}, lambda_m));
        REQUIRE(sent_m2 <= most_m2);
        if (polarisation_deg == 0.0) CHECK(most_m2 < 1.09 * sent_m2);
        tightest = std::min(tightest, most_m2 / sent_m2);
      }
  }
  CHECK(tightest < 1.03);
}

TEST_CASE("A wire flashes at broadside: half power at 0.443 lambda / 2L, first null at lambda / 2L",
          "[materials][rcs]") {
  const double lambda_m = core::kSpeedOfLight_mps / 35e9;
  const RoundWire wire{0.01, 0.5};
  const auto at = [&](double sine) {
    return rcs_m2(wire, {std::sqrt(1.0 - sine * sine), 0.0, sine}, lambda_m);
  };
  const double half = 1.3915573782515103 * lambda_m / (2.0 * kPi * 0.5);
  CHECK(at(half) == Approx(0.5 * at(0.0)).epsilon(1e-4));
  CHECK(at(lambda_m / (2.0 * 0.5)) < 1e-25 * at(0.0));
  CHECK(at(1.0) == 0.0);  // end on
}

TEST_CASE(
    "A wire that is straight over a tenth of its length has a tenth of the peak and ten times "
    "the lobe",
    "[materials][rcs]") {
  const double lambda_m = core::kSpeedOfLight_mps / 35e9;
  const RoundWire straight{0.01, 1.0};
  const RoundWire sagging{0.01, 1.0, 0.0, 0.1};
  const glm::dvec3 broadside(1.0, 0.0, 0.0);
  CHECK(rcs_m2(sagging, broadside, lambda_m) ==
        Approx(0.1 * rcs_m2(straight, broadside, lambda_m)).epsilon(1e-12));
  const auto integral = [&](const RoundWire& wire) {
    double sum = 0.0;
    for (int i = -20000; i < 20000; ++i) {
      const double sine = (i + 0.5) * 2e-5;
      sum += rcs_m2(wire, {std::sqrt(1.0 - sine * sine), 0.0, sine}, lambda_m) * 2e-5;
    }
    return sum;
  };
  // Energy over the lobe stays: pi a L.
  CHECK(integral(sagging) == Approx(integral(straight)).epsilon(0.05));
  CHECK(integral(straight) == Approx(kPi * 0.01).epsilon(0.02));
}

TEST_CASE("Sizes of round bodies are checked", "[materials][rcs]") {
  using core::ErrorClass;
  using tests::refuses;
  CHECK(refuses([] { check_rcs_model(Sphere{0.0}); }, ErrorClass::range));
  CHECK(refuses([] { check_rcs_model(SquareTrihedral{-1.0}); }, ErrorClass::range));
  CHECK(refuses([] { check_rcs_model(RoundWire{0.01, std::nan("")}); }, ErrorClass::nonfinite));
  CHECK(refuses([] { check_rcs_model(RoundWire{0.01, 1.0, 0.0, -0.1}); }, ErrorClass::range));
  CHECK(refuses(
      [] {
        check_rcs_model(RoundWire{0.01, 1.0, std::nan("")});
      },
      ErrorClass::nonfinite));
  CHECK(refuses([] { check_rcs_model(LobedRcs{-1.0, {}}); }, ErrorClass::range));
  // Extremes of what is accepted stay finite.
  for (const double size_m : {1e-6, 1.0, 1e3})
    for (const double lambda_m : {1e-6, 0.0086, 1e3}) {
      CHECK(std::isfinite(rcs_m2(Sphere{size_m}, {1, 0, 0}, lambda_m)));
      CHECK(std::isfinite(rcs_m2(RoundWire{size_m, 1.0}, {1, 0, 0}, lambda_m)));
      CHECK(std::isfinite(rcs_m2(RoundWire{size_m, 1.0}, {1e-9, 0, 1}, lambda_m)));
    }
}

}  // namespace
}  // namespace fanbeam::materials
