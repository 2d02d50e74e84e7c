// Tables of reflectivity: interpolation, and tables that make no sense.
#include "materials/nrcs/tabulated.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "core/units.h"
#include "materials/library/material_library.h"
#include "materials/nrcs/kulemin.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::radians;
using tests::refuses;

TEST_CASE("A table gives its rows exactly and follows a power law between them",
          "[materials][tabulated]") {
  const auto truth = [](double grazing_deg) {
    return kulemin_sigma0(KuleminTerrain::snow, 35e9, radians(grazing_deg));
  };
  std::vector<NrcsSample> rows;
  for (const double grazing_deg : {1.0, 3.0, 10.0, 30.0})
    rows.push_back({radians(grazing_deg), truth(grazing_deg)});
  const TabulatedNrcs table(rows);
  for (const NrcsSample& row : rows) CHECK(table.sigma0(row.grazing_rad) == Approx(row.sigma0));
  for (const double grazing_deg : {1.5, 2.0, 5.0, 20.0, 29.0})
    CHECK(table.sigma0(radians(grazing_deg)) == Approx(truth(grazing_deg)).epsilon(1e-12));
  // Nothing is made up outside.
  CHECK(table.sigma0(radians(0.2)) == rows.front().sigma0);
  CHECK(table.sigma0(radians(80.0)) == rows.back().sigma0);
  CHECK(table.sigma0(0.0) == 0.0);
  CHECK(table.sigma0(-0.1) == 0.0);
}

TEST_CASE("A table may hold a perfectly dark row", "[materials][tabulated]") {
  const TabulatedNrcs table({{0.1, 0.0}, {0.2, 1.0}, {0.3, 1.0}});
  CHECK(table.sigma0(0.05) == 0.0);
  CHECK(table.sigma0(0.15) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("M07 a one-row table is a constant", "[materials][M07]") {
  const TabulatedNrcs table({{radians(10.0), 0.25}});
  for (const double grazing_deg : {1e-9, 0.01, 1.0, 10.0, 45.0, 90.0})
    CHECK(table.sigma0(radians(grazing_deg)) == 0.25);
}

TEST_CASE("M07 tables that make no sense are refused by class", "[materials][M07]") {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  const auto refused = [](std::vector<NrcsSample> rows, ErrorClass error_class) {
    return refuses([&] { TabulatedNrcs table(rows); }, error_class);
  };
  CHECK(refused({}, ErrorClass::parse));
  CHECK(refused({{0.1, nan}}, ErrorClass::nonfinite));
  CHECK(refused({{0.1, inf}}, ErrorClass::nonfinite));
  CHECK(refused({{0.1, -1e-9}}, ErrorClass::range));
  CHECK(refused({{nan, 0.1}}, ErrorClass::nonfinite));
  CHECK(refused({{0.0, 0.1}}, ErrorClass::range));
  CHECK(refused({{1.6, 0.1}}, ErrorClass::range));
  CHECK(refused({{0.2, 0.1}, {0.1, 0.1}}, ErrorClass::range));
  CHECK(refused({{0.1, 0.1}, {0.1, 0.1}}, ErrorClass::range));
}

// A tabulated row whose arrays stand on lines 5 and 6.
core::ProblemList problems_of(const std::string& angles, const std::string& levels,
                              std::size_t expected_size) {
  core::ProblemList problems;
  const MaterialLibrary library = MaterialLibrary::from_text(
      "[measured]\nmodel = \"tabulated\"\nfrequency_range_GHz = [34, 36]\npolarisation = \"HH\"\n" +
          angles + "\n" + levels + "\nconfidence = \"seen\"\nsource = \"a test\"\n",
      "test.toml", problems);
  CHECK(library.size() == expected_size);
  return problems;
}

void require_problem(const core::ProblemList& problems, const char* code, int line) {
  REQUIRE(problems.all().size() == 1);
  INFO(to_string(problems.all().front()));
  CHECK(problems.all().front().code == code);
  CHECK(problems.all().front().place.file == "test.toml");
  CHECK(problems.all().front().place.line == line);
}

TEST_CASE("M07 a table in a library is refused with file and line", "[materials][M07]") {
  const std::string angles = "grazing_deg = [1, 3, 10]";
  CHECK(problems_of(angles, "sigma0_dB = [-30, -25, -20]", 1).all().empty());
  CHECK(problems_of("grazing_deg = [10]", "sigma0 = [0.01]", 1).all().empty());
  require_problem(problems_of(angles, "sigma0 = [0.1, nan, 0.1]", 0), "E-NONFINITE", 6);
  require_problem(problems_of(angles, "sigma0_dB = [inf, -25, -20]", 0), "E-NONFINITE", 6);
  require_problem(problems_of(angles, "sigma0 = [0.1, -0.1, 0.1]", 0), "E-RANGE", 6);
  require_problem(problems_of(angles, "sigma0_dB = [-30, -25]", 0), "E-RANGE", 5);
  require_problem(problems_of("grazing_deg = [3, 1, 10]", "sigma0_dB = [-30, -25, -20]", 0),
                  "E-RANGE", 5);
  require_problem(problems_of("grazing_deg = []", "sigma0_dB = []", 0), "E-PARSE", 5);
  require_problem(problems_of("grazing_deg = [0, 1]", "sigma0_dB = [-30, -25]", 0), "E-RANGE", 5);
}

TEST_CASE("A library row may name any model, with its own keys", "[materials][library]") {
  const auto load = [](const std::string& keys) {
    core::ProblemList problems;
    MaterialLibrary library = MaterialLibrary::from_text(
        "[row]\n" + keys + "\nconfidence = \"recalled\"\nsource = \"a test\"\n", "test.toml",
        problems);
    for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(to_string(problem));
    REQUIRE(library.size() == 1);
    return library[0];
  };
  const auto level = [&](const std::string& keys) {
    return sigma0(load(keys).model, Polarisation::horizontal, 35e9, radians(10.0));
  };
  CHECK(level("model = \"kulemin\"\nterrain = \"urban\"") ==
        kulemin_sigma0(KuleminTerrain::urban, 35e9, radians(10.0)));
  CHECK(level("model = \"git-land\"\nterrain = \"trees\"") ==
        git_land_sigma0(GitTerrain::trees, 35e9, radians(10.0)));
  CHECK(10.0 * std::log10(level("model = \"constant-gamma\"\nterrain = \"flatland\"")) ==
        Approx(-24.88).epsilon(0.0).margin(0.01));
  CHECK(level("model = \"nrl-sea\"\nsea_state = 2") > 0.0);
  CHECK(level("model = \"rough-metal\"\nrms_slope = 0.2\nrms_height_mm = 0.2") > 0.0);
  const Material oh = load(
      "model = \"oh1992\"\nmedium = \"concrete\"\nrms_height_mm = 0.2\ndielectric = "
      "\"concrete\"");
  CHECK(std::get<OhSurface>(oh.model).rms_height_m == Approx(2e-4));
  CHECK(oh.rms_height_m.value() == Approx(2e-4));  // one height for both
  CHECK(oh.dielectric == "concrete");
}

TEST_CASE("Names that do not exist are E-REF with what would be right", "[materials][library]") {
  const auto problem_of = [](const std::string& keys) {
    core::ProblemList problems;
    MaterialLibrary::from_text("[row]\n" + keys + "\nconfidence = \"seen\"\nsource = \"a test\"\n",
                               "test.toml", problems);
    REQUIRE(problems.all().size() == 1);
    return problems.all().front();
  };
  core::ProblemList unknown;
  MaterialLibrary::from_text("[row]\nmodel = \"phnog\"\n", "test.toml", unknown);
  REQUIRE(unknown.has_errors());
  CHECK(unknown.all().front().field == "row.model");
  CHECK(unknown.all().front().expected.find("\"kulemin\"") != std::string::npos);
  const core::Problem terrain = problem_of("model = \"kulemin\"\nterrain = \"moor\"");
  CHECK(terrain.code == "E-REF");
  CHECK(terrain.place.line == 3);
  CHECK(terrain.expected.find("arable-land") != std::string::npos);
  CHECK(problem_of("model = \"oh1992\"\nmedium = \"cheese\"\nrms_height_mm = 1").code == "E-REF");
  CHECK(problem_of("model = \"oh1992\"\nrms_height_mm = 1").code == "E-REF");
  const std::string sea = "model = \"nrl-sea\"\nsea_state = 1\n";
  CHECK(problem_of(sea + "dielectric = \"watre\"").expected ==
        "a medium; nearest are water, wood, marble");
  const core::Problem state = problem_of(sea + "when_wet = \"rwo\"");
  CHECK(state.code == "E-REF");
  CHECK(state.expected == "\"same\" or a material of the library; nearest are row");
  CHECK(problem_of(sea + "reference = { model = \"nrl-sea\", sea_state = 1 }").code == "E-RANGE");
}

}  // namespace
}  // namespace fanbeam::materials
