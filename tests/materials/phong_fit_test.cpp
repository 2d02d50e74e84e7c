#include "materials/nrcs/phong_fit.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "core/constants.h"
#include "core/units.h"
#include "materials/dielectric/building_materials.h"
#include "materials/nrcs/git_land.h"
#include "materials/nrcs/kulemin.h"
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

using Model = std::function<double(double grazing_rad)>;

Model kulemin(KuleminTerrain terrain) {
  return [terrain](double psi) { return kulemin_sigma0(terrain, 35e9, psi); };
}
Model git(GitTerrain terrain) {
  return [terrain](double psi) { return git_land_sigma0(terrain, GitBand::ka_35GHz, psi); };
}
Model sea(Polarisation polarisation, double sea_state) {
  return [=](double psi) { return nrl_sea_sigma0(polarisation, sea_state, 35e9, psi); };
}
Model oh_mean(const Permittivity& permittivity, double rms_height_m) {
  return [=](double psi) {
    const OhNrcs nrcs =
        oh1992_sigma0(permittivity, rms_height_m, core::kSpeedOfLight_mps / 35e9, psi);
    return 0.5 * (nrcs.hh + nrcs.vv);
  };
}

std::map<std::string, Model> published_references() {
  constexpr Polarisation kH = Polarisation::horizontal;
  constexpr Polarisation kV = Polarisation::vertical;
  const Permittivity concrete = building_permittivity(BuildingMaterial::concrete, 35e9);
  const Permittivity asphalt{5.1, 0.3};
  return {{"grass_short", git(GitTerrain::grass)},
          {"grass_tall_crops", kulemin(KuleminTerrain::grass_above_half_metre)},
          {"forest", kulemin(KuleminTerrain::forest_summer)},
          {"arable_smooth", kulemin(KuleminTerrain::arable_land)},
          {"concrete_runway", oh_mean(concrete, 0.2e-3)},
          {"asphalt_smooth", oh_mean(asphalt, 0.5e-3)},
          {"asphalt_rough_gravel", oh_mean(asphalt, 1e-3)},
          {"concrete_dark", kulemin(KuleminTerrain::concrete)},
          {"urban", kulemin(KuleminTerrain::urban)},
          {"snow_wet", git(GitTerrain::wet_snow)},
          {"snow_dry", git(GitTerrain::dry_snow)},
          {"snow_dark", kulemin(KuleminTerrain::snow)},
          {"water_ss0_HH", sea(kH, 0.0)},
          {"water_ss0_VV", sea(kV, 0.0)},
          {"water_ss1_HH", sea(kH, 1.0)},
          {"water_ss1_VV", sea(kV, 1.0)},
          {"water_ss2_HH", sea(kH, 2.0)},
          {"water_ss2_VV", sea(kV, 2.0)},
          {"water_ss3_HH", sea(kH, 3.0)},
          {"water_ss3_VV", sea(kV, 3.0)}};
}

TEST_CASE("Fits reproduce those of another program to 0.02 dB and 1 percent", "[materials][fit]") {
  const auto references = published_references();
  const std::vector<double> steep_deg = {20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80};
  for (const tests::DataRow& row : tests::data_rows("phong_fits_35GHz.csv")) {
    INFO(row.text("material"));
    // The other program's choice of angles is known for the models fitted to grazing, not for Oh's;
    // there a fifth of a dB and two percent are left.
    const bool is_oh = row.text("material").starts_with("concrete_runway") ||
                       row.text("material").starts_with("asphalt");
    const PhongFit fit = fit_phong(sample_model(references.at(row.text("material")),
                                                is_oh ? steep_deg : standard_fit_angles_deg()));
    const double relative = is_oh ? 0.02 : 0.01;
    REQUIRE(fit.nrcs.a() == Approx(row.number("a")).epsilon(relative));
    REQUIRE(fit.nrcs.b() == Approx(row.number("b")).epsilon(relative));
    REQUIRE(fit.nrcs.c() == Approx(row.number("c")).epsilon(relative));
    REQUIRE(fit.rms_dB == Approx(row.number("rms_dB")).epsilon(0.0).margin(0.011));
    REQUIRE(fit.max_dB == Approx(row.number("max_dB")).epsilon(0.0).margin(0.011));
    for (const char* angle_deg : {"3", "10", "30"}) {
      const double sine = std::sin(radians(std::stod(angle_deg)));
      const double expected_dB = row.number("level_" + std::string(angle_deg) + "_dB");
      REQUIRE(dB(fit.nrcs.sigma0(sine)) ==
              Approx(expected_dB).epsilon(0.0).margin(is_oh ? 0.1 : 0.02));
    }
  }
}

TEST_CASE("Fit recovers the coefficients of exact Phong data", "[materials][fit]") {
  for (const PhongNrcs& truth : {PhongNrcs(0.03, 0.2, 2.0), PhongNrcs(1e-6, 0.05, 3.0),
                                 PhongNrcs(0.4, 12.0, 25.0), PhongNrcs(0.05, 0.001, 6.0)}) {
    const PhongFit fit = fit_phong(sample_model(
        [&truth](double psi) { return truth.sigma0(std::sin(psi)); }, standard_fit_angles_deg()));
    INFO(truth.a() << ' ' << truth.b() << ' ' << truth.c());
    REQUIRE(fit.nrcs.a() == Approx(truth.a()).epsilon(1e-4));
    REQUIRE(fit.nrcs.b() == Approx(truth.b()).epsilon(1e-4));
    REQUIRE(fit.nrcs.c() == Approx(truth.c()).epsilon(1e-4));
    REQUIRE(fit.rms_dB < 1e-4);
  }
}

TEST_CASE("Fit keeps to the bounds: a pure lobe has a = 0, a pure Lambert law b = 0",
          "[materials][fit]") {
  const auto power_law = [](double exponent) {
    return sample_model([exponent](double psi) { return 0.3 * std::pow(std::sin(psi), exponent); },
                        standard_fit_angles_deg());
  };
  const PhongFit lobe = fit_phong(power_law(4.0));
  REQUIRE(lobe.nrcs.a() == 0.0);
  REQUIRE(lobe.nrcs.b() == Approx(0.3).epsilon(1e-4));
  REQUIRE(lobe.nrcs.c() == Approx(4.0).epsilon(1e-4));
  const PhongFit lambert = fit_phong(power_law(1.0));
  REQUIRE(lambert.nrcs.b() == 0.0);
  REQUIRE(lambert.nrcs.c() == 1.0);
  REQUIRE(lambert.nrcs.a() == Approx(0.3).epsilon(1e-12));
  // Slower than sin(psi): the bound c >= 1 binds.
  REQUIRE(fit_phong(power_law(0.5)).nrcs.b() == 0.0);
}

TEST_CASE("Fit bears angles at which a steep lobe is smaller than any double", "[materials][fit]") {
  std::vector<NrcsSample> samples;
  const std::map<double, double> level_dB = {{0.03, -60.0}, {0.1, -55.0},  {1.0, -45.0},
                                             {3.0, -40.0},  {10.0, -33.0}, {30.0, -20.0}};
  for (const auto& [grazing_deg, sigma0_dB] : level_dB)
    samples.push_back({radians(grazing_deg), std::pow(10.0, 0.1 * sigma0_dB)});
  const PhongFit fit = fit_phong(samples);
  samples[0].grazing_rad = radians(0.04);  // where no exponent up to 100 is that steep
  const PhongFit beside = fit_phong(samples);
  CHECK(fit.rms_dB == Approx(beside.rms_dB).epsilon(0.0).margin(1.0));
  CHECK(fit.nrcs.a() == Approx(beside.nrcs.a()).epsilon(0.3));
}

TEST_CASE("Fit refuses samples without a decibel value", "[materials][fit]") {
  const auto fit = [](double grazing_rad, double sigma0) {
    return [=] { fit_phong({{0.1, 1.0}, {0.2, 1.0}, {grazing_rad, sigma0}}); };
  };
  REQUIRE(refuses(fit(0.3, 0.0), ErrorClass::range));
  REQUIRE(refuses(fit(0.3, -1.0), ErrorClass::range));
  REQUIRE(refuses(fit(0.3, std::nan("")), ErrorClass::nonfinite));
  REQUIRE(refuses(fit(0.0, 1.0), ErrorClass::range));
  REQUIRE(refuses([] { fit_phong({{0.1, 1.0}, {0.2, 1.0}}); }, ErrorClass::range));
}

}  // namespace
}  // namespace fanbeam::materials
