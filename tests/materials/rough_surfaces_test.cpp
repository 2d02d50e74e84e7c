// The coherent factor of rough surfaces, Oh's model and the rough-metal model.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/roughness.h"
#include "materials/nrcs/oh1992.h"
#include "materials/nrcs/rough_metal.h"
#include "tests/decibel.h"
#include "tests/materials/error_class.h"
#include "tests/materials/ka_radar.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::kPi;
using core::radians;
using tests::dB;
using tests::kLambda_m;
using tests::refuses;

TEST_CASE("Coherent power falls to exp(-pi^2/4) at the Rayleigh limit and stays 1 at grazing",
          "[materials][roughness]") {
  // (2 k s sin)^2 = (4 pi / 8)^2 = pi^2 / 4.
  REQUIRE(coherent_power_factor(kLambda_m / 8.0, kLambda_m, kPi / 2.0) ==
          Approx(std::exp(-kPi * kPi / 4.0)).epsilon(1e-12));
  REQUIRE(coherent_power_factor(1.0, kLambda_m, 0.0) == 1.0);
  REQUIRE(coherent_power_factor(1.0, kLambda_m, kPi / 2.0) == 0.0);
  REQUIRE(refuses([] { coherent_power_factor(-1e-3, 1e-2, 0.1); }, ErrorClass::range));
  REQUIRE(refuses([] { coherent_power_factor(1e-3, 0.0, 0.1); }, ErrorClass::range));
}

TEST_CASE("Oh's model gives the independently computed levels of concrete at 20 degrees grazing",
          "[materials][oh]") {
  struct Row {
    double frequency_GHz, rms_height_mm, vv_dB, hh_dB;
  };
  // Computed by another implementation of the formula, rounded to 0.1 dB; P.2040-3 concrete.
  for (const Row& row :
       {Row{35.0, 0.2, -32.2, -38.3}, Row{35.0, 0.5, -26.0, -30.5}, Row{35.0, 1.0, -22.0, -24.8},
        Row{94.0, 0.2, -25.6, -29.9}, Row{94.0, 0.5, -20.6, -22.7}}) {
    const double frequency_Hz = row.frequency_GHz * 1e9;
    const OhNrcs nrcs = oh1992_sigma0(
        building_permittivity(BuildingMaterial::concrete, frequency_Hz), row.rms_height_mm * 1e-3,
        core::kSpeedOfLight_mps / frequency_Hz, radians(20.0));
    INFO(row.frequency_GHz << " GHz, " << row.rms_height_mm << " mm");
    REQUIRE(dB(nrcs.vv) == Approx(row.vv_dB).epsilon(0.0).margin(0.051));
    REQUIRE(dB(nrcs.hh) == Approx(row.hh_dB).epsilon(0.0).margin(0.051));
  }
}

TEST_CASE(
    "Oh's model does not tell HH from VV at vertical incidence and keeps HH below VV elsewhere",
    "[materials][oh]") {
  const Permittivity concrete{5.24, 0.383};
  const OhNrcs top = oh1992_sigma0(concrete, 1e-3, kLambda_m, kPi / 2.0);
  REQUIRE(top.hh == Approx(top.vv).epsilon(1e-12));
  for (const double grazing_deg : {80.0, 50.0, 20.0, 3.0}) {
    const OhNrcs nrcs = oh1992_sigma0(concrete, 1e-3, kLambda_m, radians(grazing_deg));
    REQUIRE(nrcs.hh < nrcs.vv);
    REQUIRE(nrcs.hv < nrcs.vv);
  }
}

TEST_CASE("Oh's model is dark for a perfectly smooth surface and for no contrast",
          "[materials][oh]") {
  REQUIRE(oh1992_sigma0({5.0, 0.3}, 0.0, kLambda_m, 0.5).vv == 0.0);
  REQUIRE(oh1992_sigma0({1.0, 0.0}, 1e-3, kLambda_m, 0.5).vv == 0.0);
  REQUIRE(refuses([] { oh1992_sigma0({5.0, -0.3}, 1e-3, 1e-2, 0.5); }, ErrorClass::range));
}

TEST_CASE("Rough metal: lobe top, diffuse floor and their energy", "[materials][metal]") {
  const RoughMetal smooth{0.2, 0.0};
  // 1 / (2 m^2) = 12.5 at the normal; nothing diffuse without roughness.
  REQUIRE(rough_metal_sigma0(smooth, kLambda_m, kPi / 2.0) == Approx(12.5).epsilon(1e-12));
  REQUIRE(rough_metal_sigma0(smooth, kLambda_m, radians(3.0)) < 1e-100);
  // 2 (1 - exp(-(4 pi s / lambda)^2)) sin(psi) far from the lobe.
  const RoughMetal rough{0.2, 0.2e-3};
  const double phase = 4.0 * kPi * 0.2e-3 / kLambda_m;
  REQUIRE(rough_metal_sigma0(rough, kLambda_m, radians(3.0)) ==
          Approx(2.0 * (1.0 - std::exp(-phase * phase)) * std::sin(radians(3.0))).epsilon(1e-12));
  REQUIRE(refuses([] { rough_metal_sigma0({0.0, 1e-4}, 1e-2, 0.5); }, ErrorClass::range));
}

TEST_CASE("Rough metal's lobe is the flash of a vehicle's side in 3GPP TR 38.901",
          "[materials][metal]") {
  // Clause 7.9.2, vehicle of 5 x 2 x 1.6 m: lobes of 20.75 dBsm (side, 8 m2), 14.56 (rear, 3.2 m2),
  // 15.52 (front), 21.26 (roof, 10 m2), thus 9.5 to 11.7 dB per area; m = 0.2 is chosen for that.
  const double top_dB = dB(rough_metal_sigma0({}, kLambda_m, kPi / 2.0));
  REQUIRE(top_dB > 9.5);
  REQUIRE(top_dB < 11.7);
}

}  // namespace
}  // namespace fanbeam::materials
