#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/units.h"
#include "materials/nrcs/constant_gamma.h"
#include "materials/nrcs/git_land.h"
#include "materials/nrcs/kulemin.h"
#include "materials/nrcs/nrl_sea.h"
#include "materials/nrcs/oh1992.h"
#include "materials/nrcs/phong_nrcs.h"
#include "materials/nrcs/rough_metal.h"

namespace fanbeam::materials {
namespace {

using NamedModel = std::pair<const char*, std::function<double(double grazing_rad)>>;

std::vector<NamedModel> named_models() {
  constexpr double kWavelength_m = 299792458.0 / 35e9;
  std::vector<NamedModel> models = {
      {"phong", [](double psi) { return PhongNrcs(0.1, 0.2, 3.3).sigma0(std::sin(psi)); }},
      {"constant gamma", [](double psi) { return constant_gamma_sigma0(0.1, psi); }},
      {"rough metal", [](double psi) { return rough_metal_sigma0({}, kWavelength_m, psi); }},
      {"oh vv",
       [](double psi) {
         return oh1992_sigma0({5.24, 0.38}, 2e-4, kWavelength_m, psi).vv;
       }},
      {"oh hh",
       [](double psi) {
         return oh1992_sigma0({5.24, 0.38}, 2e-4, kWavelength_m, psi).hh;
       }},
      {"oh hv", [](double psi) {
         return oh1992_sigma0({5.24, 0.38}, 2e-4, kWavelength_m, psi).hv;
       }}};
  for (int i = 0; i < 8; ++i)
    models.emplace_back("kulemin", [i](double psi) {
      return kulemin_sigma0(static_cast<KuleminTerrain>(i), 35e9, psi);
    });
  for (int i = 0; i < 5; ++i)
    models.emplace_back("git", [i](double psi) {
      return git_land_sigma0(static_cast<GitTerrain>(i), GitBand::ka_35GHz, psi);
    });
  for (const Polarisation polarisation : {Polarisation::horizontal, Polarisation::vertical})
    for (const double sea_state : {0.0, 6.0})
      models.emplace_back("nrl", [polarisation, sea_state](double psi) {
        return nrl_sea_sigma0(polarisation, sea_state, 35e9, psi);
      });
  return models;
}

TEST_CASE("M01 backscatter at the ends of the angle range: constant gamma", "[materials][M01]") {
  const double gamma = 0.37;
  REQUIRE(constant_gamma_sigma0(gamma, 0.0) == 0.0);
  // 1e-12 degrees is 1.745329e-14 rad.
  REQUIRE(constant_gamma_sigma0(gamma, core::radians(1e-12)) ==
          Approx(gamma * 1.7453292519943296e-14).epsilon(1e-12));
  REQUIRE(constant_gamma_sigma0(gamma, core::radians(90.0)) == Approx(gamma).epsilon(1e-12));
  REQUIRE(constant_gamma_sigma0(gamma, core::radians(-5.0)) == 0.0);
}

TEST_CASE(
    "M01 every model is finite and not negative at 0, 1e-12, 90 and -5 degrees, and dark behind",
    "[materials][M01]") {
  for (const auto& [name, sigma0] : named_models()) {
    INFO(name);
    for (const double grazing_deg : {0.0, 1e-12, 1e-300, 90.0, -5.0, -90.0}) {
      const double value = sigma0(core::radians(grazing_deg));
      INFO(grazing_deg << " deg gives " << value);
      REQUIRE(std::isfinite(value));
      REQUIRE(value >= 0.0);
      if (grazing_deg < 0.0) REQUIRE(value == 0.0);
    }
  }
}

}  // namespace
}  // namespace fanbeam::materials
