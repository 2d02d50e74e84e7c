#include "materials/dielectric/specular_surface.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "materials/dielectric/fresnel.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::kPi;
using tests::refuses;

constexpr double kWavelength_m = 0.0085655;

TEST_CASE("A smooth surface reflects by Fresnel's coefficient", "[materials][fresnel]") {
  const SpecularSurface smooth{{5.24, 0.38}, 0.0};
  for (const double grazing_deg : {0.5, 3.0, 20.0, 60.0, 90.0}) {
    const double grazing_rad = core::radians(grazing_deg);
    const FresnelReflection gamma =
        fresnel_reflection(smooth.permittivity, kPi / 2.0 - grazing_rad);
    REQUIRE(specular_reflection(smooth, Polarisation::horizontal, kWavelength_m, grazing_rad) ==
            gamma.horizontal);
    REQUIRE(specular_reflection(smooth, Polarisation::vertical, kWavelength_m, grazing_rad) ==
            gamma.vertical);
    REQUIRE(specular_power_reflection(smooth, Polarisation::vertical, kWavelength_m, grazing_rad) ==
            Approx(std::norm(gamma.vertical)).epsilon(1e-14));
  }
}

TEST_CASE("Roughness takes Ament's factor of the power and its root of the field",
          "[materials][fresnel]") {
  const SpecularSurface rough{{5.24, 0.38}, 1e-3};
  const SpecularSurface smooth{{5.24, 0.38}, 0.0};
  const double grazing_rad = core::radians(20.0);
  // 2 k s sin(psi) = 4 pi 1 mm sin(20 deg) / 8.5655 mm = 0.50178; exp(-0.50178^2) = 0.77742.
  const double power =
      specular_power_reflection(rough, Polarisation::horizontal, kWavelength_m, grazing_rad) /
      specular_power_reflection(smooth, Polarisation::horizontal, kWavelength_m, grazing_rad);
  REQUIRE(power == Approx(0.77742).epsilon(0.0).margin(2e-5));
  const std::complex<double> field =
      specular_reflection(rough, Polarisation::horizontal, kWavelength_m, grazing_rad) /
      specular_reflection(smooth, Polarisation::horizontal, kWavelength_m, grazing_rad);
  REQUIRE(field.real() == Approx(std::sqrt(0.77742)).epsilon(0.0).margin(2e-5));
  REQUIRE(std::abs(field.imag()) < 1e-15);
}

TEST_CASE("At grazing everything is a mirror with the sign turned", "[materials][fresnel]") {
  const SpecularSurface runway{{5.24, 0.38}, 0.5e-3};
  for (const Polarisation polarisation : {Polarisation::horizontal, Polarisation::vertical}) {
    const std::complex<double> gamma =
        specular_reflection(runway, polarisation, kWavelength_m, 0.0);
    REQUIRE(std::abs(gamma + 1.0) < 1e-12);
  }
  // Vertical polarisation passes its pseudo-Brewster angle, here 23.6 deg of grazing.
  REQUIRE(specular_power_reflection(runway, Polarisation::vertical, kWavelength_m,
                                    core::radians(23.6)) < 2e-3);
}

TEST_CASE("Specular reflection refuses what is no surface", "[materials][fresnel]") {
  const auto reflect = [](double loss, double rms_height_m, double grazing_rad) {
    return [=] {
      specular_power_reflection({{5.0, loss}, rms_height_m}, Polarisation::vertical, kWavelength_m,
                                grazing_rad);
    };
  };
  REQUIRE(refuses(reflect(-0.1, 0.0, 0.1), ErrorClass::range));
  REQUIRE(refuses(reflect(0.1, -1e-3, 0.1), ErrorClass::range));
  REQUIRE(refuses(reflect(0.1, 0.0, 1.6), ErrorClass::range));
  REQUIRE(refuses(reflect(0.1, 0.0, -0.1), ErrorClass::range));
  REQUIRE(refuses(reflect(0.1, std::nan(""), 0.1), ErrorClass::nonfinite));
}

}  // namespace
}  // namespace fanbeam::materials
