// Where the shipped library comes from: every row is computed again from its model, and the tables
// of docs/materials.md are compared with the library line by line.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/units.h"
#include "materials/library/material_library.h"
#include "materials/nrcs/constant_gamma.h"
#include "materials/nrcs/git_land.h"
#include "materials/nrcs/kulemin.h"
#include "materials/nrcs/nrl_sea.h"
#include "materials/nrcs/oh1992.h"
#include "materials/nrcs/phong_fit.h"
#include "materials/nrcs/rough_metal.h"

namespace fanbeam::materials {
namespace {

using core::radians;

constexpr double kReference_Hz = 35e9;

double wavelength_m(double frequency_Hz) { return core::kSpeedOfLight_mps / frequency_Hz; }
double level_dB(double power) { return 10.0 * std::log10(power); }

// sigma0 of the reference model at a frequency and a grazing angle.
using Model = std::function<double(double frequency_Hz, double grazing_rad)>;

struct Derivation {
  std::string material;
  std::string reference;  // as shown in docs/materials.md
  Model model;
  std::vector<double> grazing_deg;
  double exponent = 0.0;            // stated by the source, unless the other frequency is given:
  double other_frequency_Hz = 0.0;  // then the mean slope in dB between the two frequencies
};

const std::vector<double> kSteep_deg = {20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80};

std::vector<double> angles_to_normal_deg() {
  std::vector<double> angles = standard_fit_angles_deg();
  angles.insert(angles.end(), {65, 70, 75, 80, 85, 90});
  return angles;
}

Derivation from_git(const char* material, const char* reference, GitTerrain terrain,
                    double exponent) {
  return {
      material, reference,
      [terrain](double, double psi) { return git_land_sigma0(terrain, GitBand::ka_35GHz, psi); },
      standard_fit_angles_deg(), exponent};
}

Derivation from_kulemin(const char* material, const char* reference, KuleminTerrain terrain) {
  return {material, reference,
          [terrain](double f, double psi) { return kulemin_sigma0(terrain, f, psi); },
          standard_fit_angles_deg(), kulemin_frequency_exponent(terrain)};
}

Derivation from_gamma(const char* material, const char* reference, GammaTerrain terrain) {
  return {
      material, reference,
      [terrain](double f, double psi) { return constant_gamma_sigma0(gamma_at(terrain, f), psi); },
      standard_fit_angles_deg(), 0.5};
}

Derivation from_sea(const char* material, const char* reference, double sea_state) {
  return {material,
          reference,
          [sea_state](double f, double psi) {
            return nrl_sea_sigma0(Polarisation::horizontal, sea_state, f, psi);
          },
          standard_fit_angles_deg(),
          0.0,
          17e9};
}

using PermittivityAt = std::function<Permittivity(double frequency_Hz)>;

Derivation from_oh(const char* material, const char* reference, PermittivityAt permittivity,
                   double rms_height_m, double other_frequency_Hz) {
  return {material,
          reference,
          [=](double f, double psi) {
            return oh1992_sigma0(permittivity(f), rms_height_m, wavelength_m(f), psi).hh;
          },
          kSteep_deg,
          0.0,
          other_frequency_Hz};
}

PermittivityAt itu(BuildingMaterial material) {
  return [material](double f) { return building_permittivity(material, f); };
}

std::vector<Derivation> derivations() {
  const auto asphalt = [](double) { return Permittivity{5.1, 0.3}; };
  const auto concrete = itu(BuildingMaterial::concrete);
  return {
      from_git("short_grass", "GIT grass, 35 GHz", GitTerrain::grass, 0.6),
      from_kulemin("tall_grass", "Kulemin grass above 0.5 m",
                   KuleminTerrain::grass_above_half_metre),
      from_kulemin("crops", "Kulemin grass above 0.5 m", KuleminTerrain::grass_above_half_metre),
      from_kulemin("forest", "Kulemin forest, summer", KuleminTerrain::forest_summer),
      from_gamma("bare_soil", "constant gamma, flatland", GammaTerrain::flatland),
      from_kulemin("arable_soil", "Kulemin arable land", KuleminTerrain::arable_land),
      from_oh("gravel", "Oh HH, 5.1 - 0.3j, s = 2 mm", asphalt, 2e-3, 94e9),
      from_oh("rock", "Oh HH, P.2040 marble, s = 3 mm", itu(BuildingMaterial::marble), 3e-3, 60e9),
      from_gamma("rugged_mountain", "constant gamma, rugged mountain",
                 GammaTerrain::rugged_mountain),
      from_oh("asphalt_smooth", "Oh HH, 5.1 - 0.3j, s = 0.5 mm", asphalt, 0.5e-3, 94e9),
      from_oh("asphalt_worn", "Oh HH, 5.1 - 0.3j, s = 1 mm", asphalt, 1e-3, 94e9),
      from_oh("concrete", "Oh HH, P.2040 concrete, s = 0.2 mm", concrete, 0.2e-3, 94e9),
      from_oh("paint", "Oh HH, 5.1 - 0.3j, s = 0.3 mm", asphalt, 0.3e-3, 94e9),
      from_git("snow_dry", "GIT dry snow, 35 GHz", GitTerrain::dry_snow, 1.5),
      from_git("snow_wet", "GIT wet snow, 35 GHz", GitTerrain::wet_snow, 1.5),
      from_sea("water_calm", "NRL sea HH, sea state 0", 0.0),
      from_sea("water_rough", "NRL sea HH, sea state 3", 3.0),
      from_kulemin("urban", "Kulemin urban", KuleminTerrain::urban),
      {"metal", "rough metal, m = 0.2, s = 0.2 mm",
       [](double f, double psi) {
         return rough_metal_sigma0({0.2, 0.2e-3}, wavelength_m(f), psi);
       },
       angles_to_normal_deg()},
      from_oh("brick", "Oh HH, P.2040 brick, s = 1 mm", itu(BuildingMaterial::brick), 1e-3, 40e9),
      from_oh("wall", "Oh HH, P.2040 concrete, s = 0.5 mm", concrete, 0.5e-3, 94e9),
      from_oh("roof", "Oh HH, P.2040 concrete, s = 1.5 mm", concrete, 1.5e-3, 94e9),
  };
}

struct Derived {
  PhongFit fit;
  double exponent;
};

Derived derive(const Derivation& row) {
  const auto at_reference = [&row](double psi) { return row.model(kReference_Hz, psi); };
  double exponent = row.exponent;
  if (row.other_frequency_Hz > 0.0) {
    double sum_dB = 0.0;
    for (const double angle_deg : row.grazing_deg) {
      const double psi = radians(angle_deg);
      sum_dB += level_dB(row.model(row.other_frequency_Hz, psi) / row.model(kReference_Hz, psi));
    }
    exponent = sum_dB / static_cast<double>(row.grazing_deg.size()) /
               level_dB(row.other_frequency_Hz / kReference_Hz);
  }
  return {fit_phong(sample_model(at_reference, row.grazing_deg)), exponent};
}

MaterialLibrary shipped() {
  core::ProblemList problems;
  MaterialLibrary library = MaterialLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml", problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(to_string(problem));
  CHECK(problems.all().empty());
  return library;
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::set<std::string> lines_of_materials_page() {
  std::ifstream page(std::string(FANBEAM_SOURCE_DIR) + "/docs/materials.md");
  std::set<std::string> lines;
  for (std::string line; std::getline(page, line);) lines.insert(line);
  return lines;
}

std::string library_line(const Material& material) {
  std::string line = "| " + material.name;
  for (const double value : {material.nrcs.a(), material.nrcs.b(), material.nrcs.c()})
    line += " | " + formatted("%.4g", value);
  line += " | ";
  for (const double angle_deg : {3.0, 10.0, 30.0}) {
    const double level = level_dB(material.nrcs.sigma0(std::sin(radians(angle_deg))));
    line += formatted("%.1f", level) + (angle_deg < 30.0 ? " / " : " | ");
  }
  line += formatted("%.4g", material.frequency_exponent) + " | " +
          formatted("%g", material.frequency_range_Hz.low / 1e9) + "-" +
          formatted("%g", material.frequency_range_Hz.high / 1e9) + " | " +
          formatted("%g", core::degrees(material.grazing_range_rad.low)) + "-" +
          formatted("%g", core::degrees(material.grazing_range_rad.high)) + " | " +
          material.polarisation + " | " + name_of(material.confidence) + " |";
  return line;
}

std::string derivation_line(const Derivation& row, const Derived& derived) {
  return "| " + row.material + " | " + row.reference + " | " +
         formatted("%g", row.grazing_deg.front()) + "-" + formatted("%g", row.grazing_deg.back()) +
         " | " + formatted("%.2f", derived.fit.rms_dB) + " / " +
         formatted("%.2f", derived.fit.max_dB) + " |";
}

TEST_CASE("The library's values are what the fit to each row's model gives, to 1 percent",
          "[materials][derivation]") {
  const MaterialLibrary library = shipped();
  const std::vector<Derivation> rows = derivations();
  CHECK(library.size() == rows.size());
  for (const Derivation& row : rows) {
    const Derived derived = derive(row);
    const PhongNrcs& fitted = derived.fit.nrcs;
    INFO('[' << row.material << "]\na = " << formatted("%.5g", fitted.a()) << "\nb = "
             << formatted("%.5g", fitted.b()) << "\nc = " << formatted("%.5g", fitted.c())
             << "\nfrequency_exponent = " << formatted("%.4g", derived.exponent));
    const std::optional<std::size_t> index = library.index_of(row.material);
    CHECK(index.has_value());
    if (!index) continue;
    const Material& material = library[*index];
    CHECK(material.reference_frequency_Hz == kReference_Hz);
    CHECK(material.nrcs.a() == Approx(fitted.a()).epsilon(0.01));
    CHECK(material.nrcs.b() == Approx(fitted.b()).epsilon(0.01));
    CHECK(material.nrcs.c() == Approx(fitted.c()).epsilon(0.01));
    CHECK(material.frequency_exponent == Approx(derived.exponent).margin(0.005));
  }
}

TEST_CASE("Scaling by the exponent follows the model within 1 dB where the model is run again",
          "[materials][derivation]") {
  const MaterialLibrary library = shipped();
  for (const Derivation& row : derivations()) {
    // Oh's rows only: fitted to better than 0.1 dB, so what is left is the frequency law.
    if (row.reference.rfind("Oh", 0) != 0) continue;
    const PhongNrcs scaled =
        library[library.index_of(row.material).value()].nrcs_at(row.other_frequency_Hz);
    for (const double angle_deg : row.grazing_deg) {
      const double model = row.model(row.other_frequency_Hz, radians(angle_deg));
      INFO(row.material << " at " << angle_deg << " deg");
      CHECK(std::abs(level_dB(scaled.sigma0(std::sin(radians(angle_deg))) / model)) < 1.0);
    }
  }
}

TEST_CASE("Oh's asphalt changes by less than half a dB with the permittivity of the ITU",
          "[materials][derivation]") {
  const double lambda_m = wavelength_m(kReference_Hz);
  const Permittivity listed =
      building_permittivity(BuildingMaterial::asphalt_concrete, kReference_Hz);
  for (const double angle_deg : kSteep_deg) {
    const double assumed_hh = oh1992_sigma0({5.1, 0.3}, 0.5e-3, lambda_m, radians(angle_deg)).hh;
    const double listed_hh = oh1992_sigma0(listed, 0.5e-3, lambda_m, radians(angle_deg)).hh;
    REQUIRE(std::abs(level_dB(assumed_hh / listed_hh)) < 0.5);
  }
}

TEST_CASE("The tables of docs/materials.md are those of the library and of the fits",
          "[materials][derivation]") {
  const std::string expected_file = std::string(FANBEAM_BINARY_DIR) + "/materials_tables.md";
  std::ofstream expected(expected_file);
  const std::set<std::string> page = lines_of_materials_page();
  const auto check_line = [&](const std::string& line) {
    expected << line << '\n';
    INFO("lines to copy are in " << expected_file);
    CHECK(page.contains(line));
  };
  const MaterialLibrary library = shipped();
  for (const Material& material : library.all()) check_line(library_line(material));
  for (const Derivation& row : derivations()) check_line(derivation_line(row, derive(row)));
}

}  // namespace
}  // namespace fanbeam::materials
