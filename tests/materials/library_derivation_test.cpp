// Where the shipped library comes from: every row is computed again from its reference, and the tables
// of docs/materials.md are compared with the library line by line.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/files.h"
#include "core/units.h"
#include "materials/dielectric/building_materials.h"
#include "materials/library/library_text.h"
#include "materials/library/material_library.h"
#include "materials/nrcs/oh1992.h"
#include "tests/decibel.h"
#include "tests/materials/shipped_library.h"

namespace fanbeam::materials {
namespace {

using core::radians;
using tests::dB;
using tests::shipped_library;
using tests::shipped_library_path;

constexpr double kReference_Hz = 35e9;

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
  const PhongSurface& row = std::get<PhongSurface>(material.model);
  std::string line = "| " + material.name;
  for (const double value : {row.nrcs.a(), row.nrcs.b(), row.nrcs.c()})
    line += " | " + formatted("%.4g", value);
  line += " | ";
  for (const double angle_deg : {3.0, 10.0, 30.0}) {
    const double level = dB(row.nrcs.sigma0(std::sin(radians(angle_deg))));
    line += formatted("%.1f", level) + (angle_deg < 30.0 ? " / " : " | ");
  }
  line += formatted("%.4g", row.frequency_exponent) + " | " +
          formatted("%g", row.frequency_range_Hz.low / 1e9) + "-" +
          formatted("%g", row.frequency_range_Hz.high / 1e9) + " | " +
          formatted("%g", core::degrees(row.grazing_range_rad.low)) + "-" +
          formatted("%g", core::degrees(row.grazing_range_rad.high)) + " | " +
          (row.polarisation ? core::name_of(*row.polarisation) : "any") + " | " +
          name_of(material.confidence) + " |";
  return line;
}

// "git-land grass": the names that stand in the row's reference.
std::string reference_text(const PhongReference& reference) {
  std::string text(name_of(reference.model));
  if (const auto* gamma = std::get_if<ConstantGammaSurface>(&reference.model))
    text += " " + std::string(kGammaTerrainNames[static_cast<std::size_t>(gamma->terrain)]);
  if (const auto* kulemin = std::get_if<KuleminSurface>(&reference.model))
    text += " " + std::string(kKuleminTerrainNames[static_cast<std::size_t>(kulemin->terrain)]);
  if (const auto* git = std::get_if<GitLandSurface>(&reference.model))
    text += " " + std::string(kGitTerrainNames[static_cast<std::size_t>(git->terrain)]);
  if (const auto* sea = std::get_if<NrlSeaSurface>(&reference.model))
    text += ", sea state " + formatted("%g", sea->sea_state);
  if (const auto* metal = std::get_if<RoughMetal>(&reference.model))
    text += ", m = " + formatted("%g", metal->rms_slope) +
            ", s = " + formatted("%g", metal->rms_height_m * 1000.0) + " mm";
  if (const auto* oh = std::get_if<OhSurface>(&reference.model)) {
    const auto* medium = std::get_if<DielectricMedium>(&oh->medium);
    const auto* figure = std::get_if<Permittivity>(&oh->medium);
    text += ", " +
            (medium != nullptr
                 ? std::string(name_of(*medium))
                 : formatted("%g", figure->real) + " - " + formatted("%gj", figure->loss)) +
            ", s = " + formatted("%g", oh->rms_height_m * 1000.0) + " mm";
  }
  if (reference.offset_dB != 0.0) text += ", plus " + formatted("%g", reference.offset_dB) + " dB";
  return text;
}

std::string derivation_line(const Material& material) {
  const PhongDerivation derived =
      derive(std::get<PhongSurface>(material.model), *material.reference);
  const std::vector<double>& angles_deg = fit_angles_deg(material.reference->angles);
  return "| " + material.name + " | " + reference_text(*material.reference) + " | " +
         formatted("%g", angles_deg.front()) + "-" + formatted("%g", angles_deg.back()) + " | " +
         formatted("%.2f", derived.fit.rms_dB) + " / " + formatted("%.2f", derived.fit.max_dB) +
         " |";
}

TEST_CASE("The shipped library is what the fits to its own references give, byte for byte",
          "[materials][derivation]") {
  const std::string file = shipped_library_path();
  const std::string text = core::read_file(file, 1 << 20);
  core::ProblemList problems;
  const std::string again = with_fits_made_again(text, file, problems);
  REQUIRE(problems.all().empty());
  std::istringstream lines(text), lines_again(again);
  for (std::string line, line_again; std::getline(lines, line);) {
    std::getline(lines_again, line_again);
    CHECK(line_again == line);
  }
  REQUIRE(again == text);
  const MaterialLibrary library = shipped_library();
  for (const Material& material : library.all()) CHECK(material.reference.has_value());
}

TEST_CASE("Making the fits again repairs spoilt figures and touches nothing else",
          "[materials][derivation]") {
  const std::string file = shipped_library_path();
  const std::string text = core::read_file(file, 1 << 20);
  std::string spoilt = text;
  const std::size_t grass = spoilt.find("a = 0.032527");
  REQUIRE(grass != std::string::npos);
  spoilt.replace(grass, 12, "a = 0.5");
  const std::size_t asphalt = spoilt.find("frequency_exponent = 1.637");
  REQUIRE(asphalt != std::string::npos);
  spoilt.replace(asphalt, 26, "frequency_exponent = 1");
  core::ProblemList problems;
  CHECK(with_fits_made_again(spoilt, file, problems) == text);
  std::string windows, spoilt_windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const char c : spoilt) spoilt_windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(with_fits_made_again(spoilt_windows, file, problems) == windows);
  const std::string broken = text + "[broken\n";
  CHECK(with_fits_made_again(broken, file, problems) == broken);
  CHECK(problems.has_errors());
}

TEST_CASE("Scaling by the exponent follows the model within 1 dB where the model is run again",
          "[materials][derivation]") {
  const MaterialLibrary library = shipped_library();
  for (const Material& material : library.all()) {
    // Oh's rows only: fitted to better than 0.1 dB, so what is left is the frequency law.
    const PhongReference& reference = *material.reference;
    if (!std::holds_alternative<OhSurface>(reference.model)) continue;
    // Water under the wet rows has a law of its own: 2 dB.
    const bool wet = material.dielectric == "water";
    const PhongSurface& row = std::get<PhongSurface>(material.model);
    const PhongNrcs scaled = row.at_frequency(reference.exponent_to_Hz);
    for (const double angle_deg : fit_angles_deg(reference.angles)) {
      const double model = sigma0(reference.model, Polarisation::horizontal,
                                  reference.exponent_to_Hz, radians(angle_deg));
      INFO(material.name << " at " << angle_deg << " deg");
      CHECK(std::abs(dB(scaled.sigma0(std::sin(radians(angle_deg))) / model)) < (wet ? 2.0 : 1.0));
    }
  }
}

TEST_CASE("Oh's asphalt changes by less than half a dB with the permittivity of the ITU",
          "[materials][derivation]") {
  const double lambda_m = core::kSpeedOfLight_mps / kReference_Hz;
  const Permittivity listed =
      building_permittivity(BuildingMaterial::asphalt_concrete, kReference_Hz);
  for (const double angle_deg : fit_angles_deg(FitAngles::steep)) {
    const double assumed_hh = oh1992_sigma0({5.1, 0.3}, 0.5e-3, lambda_m, radians(angle_deg)).hh;
    const double listed_hh = oh1992_sigma0(listed, 0.5e-3, lambda_m, radians(angle_deg)).hh;
    REQUIRE(std::abs(dB(assumed_hh / listed_hh)) < 0.5);
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
  const MaterialLibrary library = shipped_library();
  for (const Material& material : library.all()) check_line(library_line(material));
  for (const Material& material : library.all()) check_line(derivation_line(material));
}

}  // namespace
}  // namespace fanbeam::materials
