// The one interface of all reflectivity models: values, refusals, and what is done outside.
#include "materials/nrcs/surface_model.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/units.h"
#include "materials/nrcs/nrcs_curve.h"
#include "materials/nrcs/nrl_sea.h"
#include "materials/nrcs/oh1992.h"
#include "tests/data_rows.h"
#include "tests/decibel.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::radians;
using tests::dB;
using tests::refuses;

constexpr Polarisation kH = Polarisation::horizontal;
constexpr Polarisation kV = Polarisation::vertical;

// One of each kind, and every terrain of the empirical ones.
std::vector<SurfaceModel> every_model() {
  std::vector<SurfaceModel> models = {
      PhongSurface{{0.1, 0.2, 3.3}, 35e9, 0.5, {30e9, 40e9}, {radians(1.0), radians(60.0)}, kH},
      OhSurface{Permittivity{5.24, 0.38}, 2e-4, 288.15},
      OhSurface{DielectricMedium::water, 1e-3, 283.15}, RoughMetal{},
      TabulatedSurface{
          TabulatedNrcs({{radians(2.0), 0.01}, {radians(30.0), 0.1}}), {30e9, 40e9}, std::nullopt}};
  for (int i = 0; i < 8; ++i) models.push_back(ConstantGammaSurface{static_cast<GammaTerrain>(i)});
  for (int i = 0; i < 8; ++i) models.push_back(KuleminSurface{static_cast<KuleminTerrain>(i)});
  for (int i = 0; i < 5; ++i) models.push_back(GitLandSurface{static_cast<GitTerrain>(i)});
  for (const double sea_state : {0.0, 3.0, 6.0}) models.push_back(NrlSeaSurface{sea_state});
  return models;
}

TEST_CASE("Every model gives the independently computed values through the interface",
          "[materials][models]") {
  const std::map<std::string, SurfaceModel> land = {
      {"kulemin concrete", KuleminSurface{KuleminTerrain::concrete}},
      {"kulemin arable_land", KuleminSurface{KuleminTerrain::arable_land}},
      {"kulemin snow", KuleminSurface{KuleminTerrain::snow}},
      {"kulemin forest_summer", KuleminSurface{KuleminTerrain::forest_summer}},
      {"kulemin grass_over_0.5m", KuleminSurface{KuleminTerrain::grass_above_half_metre}},
      {"kulemin urban", KuleminSurface{KuleminTerrain::urban}},
      {"git_land grass", GitLandSurface{GitTerrain::grass}},
      {"git_land trees", GitLandSurface{GitTerrain::trees}},
      {"git_land wet_snow", GitLandSurface{GitTerrain::wet_snow}},
      {"git_land dry_snow", GitLandSurface{GitTerrain::dry_snow}}};
  for (const tests::DataRow& row : tests::data_rows("nrcs_model_vectors.csv")) {
    const bool sea = row.text("model") == "nrl_sea";
    const std::string name = row.text("model") + " " + row.text("terrain");
    INFO(name << ' ' << row.text("frequency_GHz") << " GHz " << row.text("grazing_deg"));
    const SurfaceModel model = sea ? NrlSeaSurface{row.number("sea_state")} : land.at(name);
    const double value =
        sigma0(model, row.text("polarisation") == "V" ? kV : kH, row.number("frequency_GHz") * 1e9,
               radians(row.number("grazing_deg")));
    // The NRL rows use coefficients with one digit less.
    CHECK(std::abs(dB(value) - row.number("sigma0_dB")) < (sea ? 0.02 : 6e-4));
  }
}

TEST_CASE("M01 every model at the ends of the angle range, through the interface",
          "[materials][M01]") {
  for (const SurfaceModel& model : every_model()) {
    const double frequency_Hz = 35e9;
    INFO(name_of(model));
    const auto at = [&](double grazing_deg) {
      return sigma0(model, kH, frequency_Hz, radians(grazing_deg));
    };
    CHECK(at(0.0) == 0.0);
    CHECK(at(-5.0) == 0.0);
    CHECK(at(-90.0) == 0.0);
    for (const double grazing_deg : {1e-12, 1e-6, 0.05, 0.1, 1.0, 30.0, 60.0, 89.999, 90.0}) {
      INFO(grazing_deg << " deg");
      CHECK(std::isfinite(at(grazing_deg)));
      CHECK(at(grazing_deg) >= 0.0);
    }
    // The ratio to sin(psi), which the radar equation needs, stays finite too.
    CHECK(at(1e-12) / std::sin(radians(1e-12)) < 1e3);
    CHECK(refuses([&] { at(91.0); }, ErrorClass::range));
    CHECK(refuses([&] { at(std::nan("")); }, ErrorClass::nonfinite));
  }
  const double gamma = gamma_at(GammaTerrain::farmland, 35e9);
  const ConstantGammaSurface farmland{GammaTerrain::farmland};
  CHECK(sigma0(farmland, kH, 35e9, radians(1e-12)) ==
        Approx(gamma * 1.7453292519943296e-14).epsilon(1e-12));
  CHECK(sigma0(farmland, kH, 35e9, radians(90.0)) == Approx(gamma).epsilon(1e-12));
}

TEST_CASE("Below 0.1 degrees sigma0 follows sin(psi), without a step", "[materials][models]") {
  for (const SurfaceModel& model :
       {SurfaceModel(KuleminSurface{KuleminTerrain::urban}), SurfaceModel(NrlSeaSurface{2.0}),
        SurfaceModel(GitLandSurface{GitTerrain::trees})}) {
    const double at_end = sigma0(model, kV, 35e9, radians(0.1));
    CHECK(sigma0(model, kV, 35e9, radians(0.0999999)) == Approx(at_end).epsilon(2e-6));
    CHECK(sigma0(model, kV, 35e9, radians(0.01)) == Approx(at_end / 10.0).epsilon(1e-5));
  }
}

TEST_CASE("Empirical models are held above 60 degrees, where NRL's formula would run away",
          "[materials][models]") {
  const NrlSeaSurface sea{3.0};
  CHECK(sigma0(sea, kH, 35e9, radians(90.0)) == sigma0(sea, kH, 35e9, radians(60.0)));
  CHECK(dB(nrl_sea_sigma0(kH, 3.0, 35e9, radians(90.0))) >
        dB(sigma0(sea, kH, 35e9, radians(90.0))) + 15.0);
  const KuleminSurface concrete{KuleminTerrain::concrete};
  CHECK(sigma0(concrete, kH, 35e9, radians(75.0)) ==
        kulemin_sigma0(KuleminTerrain::concrete, 35e9, radians(60.0)));
  // Between the source's 30 deg and 60 deg the formula goes on.
  CHECK(sigma0(concrete, kH, 35e9, radians(45.0)) ==
        kulemin_sigma0(KuleminTerrain::concrete, 35e9, radians(45.0)));
}

TEST_CASE("A model refuses what lies outside its publication, with the allowed range",
          "[materials][models]") {
  const auto refused = [](const SurfaceModel& model, Polarisation polarisation,
                          double frequency_Hz) {
    return refuses([&] { sigma0(model, polarisation, frequency_Hz, 0.1); }, ErrorClass::range);
  };
  CHECK(refused(NrlSeaSurface{2.0}, kH, 35.1e9));
  CHECK(refused(NrlSeaSurface{2.0}, kV, 94e9));
  CHECK_FALSE(refused(NrlSeaSurface{2.0}, kV, 35e9));
  CHECK(refused(KuleminSurface{}, kH, 2.9e9));
  CHECK(refused(KuleminSurface{}, kH, 101e9));
  CHECK(refused(ConstantGammaSurface{}, kH, 140e9));
  CHECK(refused(GitLandSurface{GitTerrain::grass}, kH, 9.9e9));
  CHECK(refused(GitLandSurface{GitTerrain::grass}, kH, 96e9));
  CHECK(refused(GitLandSurface{GitTerrain::urban}, kH, 35e9));
  CHECK_FALSE(refused(GitLandSurface{GitTerrain::urban}, kH, 10e9));
  // k s of 0.1 to 6: 0.2 mm from 23.9 GHz up, 10 mm only to 28.6 GHz. Brick ends at 40 GHz.
  CHECK(refused(OhSurface{DielectricMedium::concrete, 2e-4, 288.15}, kH, 20e9));
  CHECK_FALSE(refused(OhSurface{DielectricMedium::concrete, 2e-4, 288.15}, kH, 35e9));
  CHECK(refused(OhSurface{DielectricMedium::concrete, 1e-2, 288.15}, kH, 35e9));
  CHECK(refused(OhSurface{DielectricMedium::brick, 1e-3, 288.15}, kH, 76e9));
  const PhongSurface row{{0.1, 0.2, 3.0}, 35e9, 0.5, {30e9, 40e9}, {0.02, 1.0}, kH};
  CHECK(refused(row, kH, 76e9));
  CHECK(refused(row, kV, 35e9));
  CHECK_FALSE(refused(row, kH, 35e9));
  try {
    sigma0(NrlSeaSurface{2.0}, kH, 76e9, 0.1);
    FAIL("was accepted");
  } catch (const core::InputError& error) {
    CHECK(std::string(error.what()).find("frequency_GHz = 76") != std::string::npos);
    CHECK(std::string(error.what()).find("0.5 to 35 (model nrl-sea)") != std::string::npos);
  }
  CHECK(refuses([] { sigma0(NrlSeaSurface{7.0}, kH, 35e9, 0.1); }, ErrorClass::range));
  CHECK(refuses([] { sigma0(KuleminSurface{}, kH, std::nan(""), 0.1); }, ErrorClass::nonfinite));
}

TEST_CASE("A curve outside a model's frequencies keeps the nearest; a Phong row is scaled",
          "[materials][models]") {
  const double sine = std::sin(radians(5.0));
  CHECK(NrcsCurve(NrlSeaSurface{2.0}, kH, 94e9).sigma0(sine) ==
        NrcsCurve(NrlSeaSurface{2.0}, kH, 35e9).sigma0(sine));
  CHECK(NrcsCurve(GitLandSurface{GitTerrain::urban}, kH, 35e9).sigma0(sine) ==
        Approx(git_land_sigma0(GitTerrain::urban, GitBand::x_10GHz, radians(5.0))).epsilon(1e-12));
  const PhongSurface row{{0.1, 0.2, 3.0}, 35e9, 0.5, {30e9, 40e9}, {0.02, 1.0}, kH};
  CHECK(NrcsCurve(row, kV, 140e9).sigma0(sine) == 2.0 * row.nrcs.sigma0(sine));
  // Soil of 80 mm is within Oh's data up to 3.6 GHz, its medium known from 4 GHz on; of 1 um it would
  // be from 4800 GHz on, the medium known to 37 GHz. The end of the medium's frequencies is nearest.
  const OhSurface ploughed{DielectricMedium::moist_soil, 0.08, 288.15};
  CHECK(validity_of(ploughed).frequency_Hz.low == 4e9);
  CHECK(validity_of(ploughed).frequency_Hz.high == 4e9);
  CHECK(NrcsCurve(ploughed, kH, 35e9).sigma0(sine) == NrcsCurve(ploughed, kH, 4e9).sigma0(sine));
  CHECK(NrcsCurve(ploughed, kH, 35e9).sigma0(sine) > 0.0);
  const OhSurface smooth{DielectricMedium::moist_soil, 1e-6, 288.15};
  CHECK(validity_of(smooth).frequency_Hz.low == 37e9);
  CHECK(validity_of(smooth).frequency_Hz.high == 37e9);
  CHECK(NrcsCurve(PhongNrcs(0.1, 0.2, 3.0)).sigma0(sine) == row.nrcs.sigma0(sine));
  CHECK(NrcsCurve().sigma0(1.0) == 0.0);
  CHECK(NrcsCurve(row, kH, 35e9).sigma0(-0.1) == 0.0);
}

TEST_CASE("Polarisations differ where the model tells them apart, and only there",
          "[materials][models]") {
  const auto ratio_dB = [](const SurfaceModel& model) {
    return dB(sigma0(model, kV, 35e9, radians(20.0)) / sigma0(model, kH, 35e9, radians(20.0)));
  };
  // Reference figures of Oh's model for concrete of 0.2 mm at 35 GHz, 20 deg: -32.2 / -38.3 dB.
  CHECK(ratio_dB(OhSurface{DielectricMedium::concrete, 2e-4, 288.15}) ==
        Approx(6.1).epsilon(0.0).margin(0.1));
  CHECK(ratio_dB(NrlSeaSurface{0.0}) > 1.0);
  CHECK(ratio_dB(KuleminSurface{}) == 0.0);
  CHECK(ratio_dB(GitLandSurface{}) == 0.0);
  CHECK(ratio_dB(RoughMetal{}) == 0.0);
}

TEST_CASE("GIT gives its rows at 10, 35 and 95 GHz and a straight line in dB between",
          "[materials][models]") {
  // A (psi + C)^B by hand: grass at 10 deg.
  const double psi = radians(10.0);
  const auto grass = [&](double frequency_Hz) {
    return git_land_sigma0(GitTerrain::grass, frequency_Hz, psi);
  };
  CHECK(grass(10e9) == Approx(0.023 * std::pow(psi + 0.012, 1.5)).epsilon(1e-12));
  CHECK(grass(35e9) == Approx(0.125 * std::pow(psi + 0.012, 1.5)).epsilon(1e-12));
  CHECK(grass(95e9) == Approx(0.30 * std::pow(psi + 0.012, 1.5)).epsilon(1e-12));
  CHECK(git_land_sigma0(GitTerrain::trees, 10e9, psi) ==
        Approx(0.002 * std::pow(psi + 0.002, 0.64)).epsilon(1e-12));
  const double middle_Hz = std::sqrt(10e9 * 35e9);
  CHECK(dB(grass(middle_Hz)) == Approx((dB(grass(10e9)) + dB(grass(35e9))) / 2.0).epsilon(1e-12));
  CHECK(dB(grass(76e9)) > dB(grass(35e9)));
  CHECK(dB(grass(76e9)) < dB(grass(95e9)));
}

TEST_CASE("Every model says what it knows", "[materials][models]") {
  for (const SurfaceModel& model : every_model()) {
    INFO(name_of(model));
    const ModelValidity known = validity_of(model);
    CHECK(known.frequency_Hz.low <= known.frequency_Hz.high);
    CHECK(known.frequency_Hz.contains(35e9));
    CHECK(known.grazing_rad.low < known.grazing_rad.high);
    CHECK((known.horizontal || known.vertical));
    CHECK(source_of(model).size() > 10);
    CHECK(extrapolations_of(model, kH, 35e9).empty());
  }
}

}  // namespace
}  // namespace fanbeam::materials
