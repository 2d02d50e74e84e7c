#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "materials/nrcs/oh1992.h"
#include "materials/open_material/permittivity_table.h"
#include "tests/materials/open_material_files.h"

namespace fanbeam::materials {
namespace {

using core::Polarisation;
using core::radians;
using tests::open_surface;
using tests::OpenMaterialFolder;

double value_at(const SurfaceModel& surface, const RadarQuery& query, double grazing_deg) {
  return sigma0(surface, query.polarisation, query.frequency_Hz, radians(grazing_deg));
}

double open_value(const std::string& name, const RadarQuery& query, double grazing_deg) {
  const tests::OpenSurface result = open_surface(tests::open_material_data(), name, query);
  for (const core::Problem& problem : result.problems.all())
    UNSCOPED_INFO(core::to_string(problem));
  REQUIRE_FALSE(result.problems.has_errors());
  REQUIRE(result.surface);
  return value_at(*result.surface, query, grazing_deg);
}

TEST_CASE("Custom properties give the reflectivity of their polarisation and frequency",
          "[materials][open_material]") {
  const double sin30 = 0.5;
  REQUIRE(open_value("Steel", {35e9, Polarisation::horizontal}, 30.0) ==
          Approx(0.5 * sin30 + 2.0 * std::pow(sin30, 8.0)).epsilon(1e-12));
  // The entry for VV goes before the one for any.
  REQUIRE(open_value("Steel", {35e9, Polarisation::vertical}, 30.0) ==
          Approx(0.25 * sin30 + 2.0 * std::pow(sin30, 8.0)).epsilon(1e-12));
  // The table at 76 GHz, at a row and half way between two in the logarithm of the angle.
  REQUIRE(open_value("Steel", {77e9, Polarisation::vertical}, 10.0) == Approx(0.1).epsilon(1e-12));
  REQUIRE(10.0 * std::log10(open_value("Steel", {77e9, Polarisation::vertical}, std::sqrt(10.0))) ==
          Approx(-15.0).epsilon(1e-9));
}

TEST_CASE("A name that the asset replaces is looked up under its new name",
          "[materials][open_material]") {
  REQUIRE(open_value("Old_Steel", {}, 30.0) == open_value("Steel", {}, 30.0));
  // Without the asset the replacement is unknown, the rest of the mapping is there.
  core::ProblemList problems;
  const auto folder = tests::open_material_data();
  const OpenMaterials mapping(folder / "block.xomm", folder, {}, problems);
  REQUIRE(mapping.knows("Steel"));
  REQUIRE_FALSE(mapping.knows("Old_Steel"));
  REQUIRE_FALSE(mapping.knows("Wood"));
  REQUIRE(problems.all().empty());
}

TEST_CASE("A BRDF gives 4 pi f cos^2 in the backscatter direction", "[materials][open_material]") {
  // 0.05 per sr from the normal to 30 deg, linear to 0.02 at 60 deg, held beyond. The rows of the
  // mirror direction (0.3) and of a lidar's wavelength must not show.
  const auto expected = [](double zenith_deg, double brdf_per_sr) {
    return 4.0 * core::kPi * brdf_per_sr * std::pow(std::cos(radians(zenith_deg)), 2.0);
  };
  for (const Polarisation polarisation : {Polarisation::horizontal, Polarisation::vertical}) {
    const RadarQuery query{35e9, polarisation};
    REQUIRE(open_value("Panel", query, 90.0) == Approx(expected(0.0, 0.05)).epsilon(1e-9));
    REQUIRE(open_value("Panel", query, 60.0) == Approx(expected(30.0, 0.05)).epsilon(1e-5));
    REQUIRE(open_value("Panel", query, 45.0) == Approx(expected(45.0, 0.035)).epsilon(1e-3));
    REQUIRE(open_value("Panel", query, 30.0) == Approx(expected(60.0, 0.02)).epsilon(1e-5));
    REQUIRE(open_value("Panel", query, 3.0) == Approx(expected(87.0, 0.02)).epsilon(1e-5));
    REQUIRE(open_value("Panel", query, 0.37) == Approx(expected(89.63, 0.02)).epsilon(1e-4));
  }
}

TEST_CASE("A BRDF that is found at a frequency is known there", "[materials][open_material]") {
  // Panel's is of 8.5655 mm, 35 GHz: it serves 31.82 to 38.89 GHz, and nothing else does.
  for (const double frequency_GHz : {31.6, 31.8, 31.9, 38.6, 38.8, 39.0}) {
    const RadarQuery query{frequency_GHz * 1e9};
    const tests::OpenSurface result = open_surface(tests::open_material_data(), "Panel", query);
    INFO(frequency_GHz);
    CHECK(result.surface.has_value() == (frequency_GHz > 31.82 && frequency_GHz < 38.88));
    if (!result.surface)
      CHECK(told(result) ==
            std::vector<std::string>{"E-UNSUPPORTED panel.xomp /materialProperties"});
  }
}

TEST_CASE("A diffuse reflector of reflectance 1 has gamma 4: sigma0 = 4 sin^2(psi)",
          "[materials][open_material]") {
  // Lambert's f = 1 / pi.
  const OpenMaterialFolder folder;
  folder.replace("materials/panel_brdf.xompt", "0.05]", "0.31830988618]");
  folder.replace("materials/panel_brdf.xompt", "0.05]", "0.31830988618]");
  folder.replace("materials/panel_brdf.xompt", "0.02]", "0.31830988618]");
  folder.replace("materials/panel_brdf.xompt", "0.02]", "0.31830988618]");
  const tests::OpenSurface result = open_surface(folder.path(), "Panel");
  REQUIRE(result.surface);
  for (const double grazing_deg : {0.5, 7.3, 44.0, 90.0})
    REQUIRE(value_at(*result.surface, {}, grazing_deg) ==
            Approx(4.0 * std::pow(std::sin(radians(grazing_deg)), 2.0)).epsilon(2e-4));
}

TEST_CASE("Surface height and permittivity give Oh's reflectivity", "[materials][open_material]") {
  // At 35 GHz and 293 K both neighbours have eps' = 5.24; the loss is linear in log wavelength
  // between 0.32 (4 mm) and 0.40 (10 mm, the row of the lower humidity).
  const double wavelength_m = core::kSpeedOfLight_mps / 35e9;
  const double share = std::log(wavelength_m / 0.004) / std::log(0.01 / 0.004);
  const Permittivity eps{5.24, 0.32 + share * 0.08};
  const RadarQuery query{35e9, Polarisation::vertical, 295.0};
  const OhNrcs expected = oh1992_sigma0(eps, 0.5e-3, wavelength_m, radians(30.0));
  REQUIRE(open_value("Concrete", query, 30.0) == Approx(expected.vv).epsilon(1e-12));
  const RadarQuery horizontal{35e9, Polarisation::horizontal, 295.0};
  REQUIRE(open_value("Concrete", horizontal, 30.0) == Approx(expected.hh).epsilon(1e-12));
}

TEST_CASE("The permittivity table takes the nearest temperature and stays near its wavelengths",
          "[materials][open_material]") {
  core::ProblemList problems;
  const PermittivityTable table = PermittivityTable::from_file(
      tests::open_material_data() / "materials" / "concrete_emp.xompt", problems);
  REQUIRE(problems.all().empty());
  const auto at = [&](double wavelength_m, double temperature_K) {
    return table.at({core::kSpeedOfLight_mps / wavelength_m, {}, temperature_K});
  };
  REQUIRE(at(0.01, 270.0).value->real == 5.0);
  REQUIRE(at(0.01, 300.0).value->real == 5.24);
  REQUIRE(at(0.004, 280.0).value->loss == 0.30);
  REQUIRE(at(0.0109, 300.0).value->real == 5.24);  // 9 % beyond the last row: held
  REQUIRE_FALSE(at(0.0112, 300.0).value);
  REQUIRE(at(0.0112, 300.0).why_not == "wavelengths 4 mm to 10 mm, not 11.2 mm");
}

TEST_CASE("Metals are taken as conductors, magnetic media and gain are not taken",
          "[materials][open_material]") {
  const OpenMaterialFolder folder;
  const auto permittivity = [&](const std::string& row) {
    folder.write("emp.xompt", R"({"metadata": {"name": "x", "materialVersion": "1.0.0",
      "uuid": "00000000-0000-4000-8000-0000000000ff", "openMaterial3dVersion": "1.0.0",
      "copyrights": ["x"], "license": "x", "authors": ["x"]},
      "electromagneticProperties": [)" +
                                  row + "]}");
    core::ProblemList problems;
    const auto table = PermittivityTable::from_file(folder.path() / "emp.xompt", problems);
    REQUIRE_FALSE(problems.has_errors());
    return table.at({});
  };
  const auto metal = permittivity("[0.0085655, 293, null, 1, 0, -18000, 5100000]");
  REQUIRE(metal.value->real == 1.0);
  REQUIRE(metal.value->loss == 5100000.0);
  REQUIRE_FALSE(permittivity("[0.0085655, null, null, 1, 0, -18, 25]").value);
  REQUIRE(permittivity("[0.0085655, null, null, 4, 0.5, 6, 1]").why_not ==
          "a magnetic medium, mu other than 1");
  REQUIRE(permittivity("[0.0085655, null, null, null, null, 6, null]").why_not ==
          "no row with a wavelength, eps' and eps''");
}

TEST_CASE("Custom properties go before a BRDF, a BRDF before roughness",
          "[materials][open_material]") {
  const OpenMaterialFolder folder;
  // Steel has all but a permittivity.
  folder.replace("materials/steel.xomp", "\"brdfUris\"",
                 "\"electromagneticPropertiesUri\": \"concrete_emp.xompt\", \"brdfUris\"");
  const RadarQuery query{35e9, Polarisation::vertical};
  REQUIRE(name_of(*open_surface(folder.path(), "Steel", query).surface) == "phong");
  folder.replace("materials/steel.xomp", "\"fanbeam\"", "\"others\"");
  REQUIRE(name_of(*open_surface(folder.path(), "Steel", query).surface) == "tabulated");
  folder.replace("materials/steel.xomp", "\"brdfUris\"", "\"brdfs\"");
  REQUIRE(name_of(*open_surface(folder.path(), "Steel", query).surface) == "oh1992");
}

TEST_CASE("A material that nothing serves is refused with all that was missing",
          "[materials][open_material]") {
  const auto refusal = [](const std::string& name, double frequency_Hz) {
    const tests::OpenSurface result =
        open_surface(tests::open_material_data(), name, {frequency_Hz});
    REQUIRE_FALSE(result.surface);
    REQUIRE(result.problems.all().size() == 1);
    const core::Problem problem = result.problems.all().front();
    REQUIRE(problem.code == "E-UNSUPPORTED");
    REQUIRE(problem.field == "/materialProperties");
    return problem.value + ": " + problem.expected;
  };
  REQUIRE(refusal("Glass", 35e9) ==
          "no reflectivity at 35 GHz, HH: customProperties.fanbeam.nrcs (missing), brdfUris "
          "(missing) or surfaceRoughness with electromagneticPropertiesUri (no permittivity)");
  REQUIRE(refusal("Steel", 94e9) ==
          "no reflectivity at 94 GHz, HH: customProperties.fanbeam.nrcs (no entry for this "
          "frequency and polarisation), brdfUris (no backscatter within 10 % of the wavelength) or "
          "surfaceRoughness with electromagneticPropertiesUri (no permittivity)");
}

TEST_CASE("Oh's model beyond its data is refused, or told where the scene allows it",
          "[materials][open_material]") {
  const OpenMaterialFolder folder;
  folder.replace("materials/concrete.xomp", "0.0005", "0.00005");  // k s = 0.04
  const tests::OpenSurface refused = open_surface(folder.path(), "Concrete");
  REQUIRE_FALSE(refused.surface);
  REQUIRE(tests::told(refused) ==
          std::vector<std::string>{"E-RANGE concrete.xomp oh1992 at frequency_GHz"});
  const tests::OpenSurface allowed =
      open_surface(folder.path(), "Concrete", {35e9, Polarisation::horizontal, 288.15, true});
  REQUIRE(allowed.surface);
  REQUIRE(tests::told(allowed) ==
          std::vector<std::string>{"W-EXTRAPOLATED concrete.xomp oh1992 at frequency_GHz"});
}

TEST_CASE("Every file that was read is listed once", "[materials][open_material]") {
  const tests::OpenSurface result = open_surface(tests::open_material_data(), "Panel");
  std::vector<std::string> names;
  for (const auto& file : result.files) names.push_back(file.filename().string());
  REQUIRE(names == std::vector<std::string>{"block.xoma", "block.xomm", "panel.xomp",
                                            "panel_brdf.xompt", "panel_reflCoeff.xompt"});
  core::ProblemList problems;
  OpenMaterials twice(tests::open_material_data() / "block.xoma", tests::open_material_data(), {},
                      problems);
  twice.surface_of("Steel", problems);
  twice.surface_of("Old_Steel", problems);
  REQUIRE(twice.files().size() == 4);
}

}  // namespace
}  // namespace fanbeam::materials
