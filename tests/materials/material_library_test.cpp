#include "materials/library/material_library.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/materials/error_class.h"
#include "tests/materials/shipped_library.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::Problem;
using core::ProblemList;
using tests::shipped_library;

// A material with one line replaced; the coefficients stand on lines 2 to 4.
std::string material_text(const std::string& a, const std::string& b, const std::string& c,
                          const std::string& more = "") {
  return "[test_grass]\na = " + a + "\nb = " + b + "\nc = " + c +
         "\nreference_frequency_GHz = 35\nfrequency_exponent = 0.5\nfrequency_range_GHz = [30, "
         "40]\n"
         "grazing_range_deg = [1, 60]\npolarisation = \"HH\"\nconfidence = \"seen\"\n"
         "source = \"a test\"\n" +
         more;
}

ProblemList problems_of(const std::string& text, std::size_t expected_size = 0) {
  ProblemList problems;
  const MaterialLibrary library = MaterialLibrary::from_text(text, "test.toml", problems);
  REQUIRE(library.size() == expected_size);
  return problems;
}

void require_problem(const ProblemList& problems, const char* code, int line, const char* field) {
  for (const Problem& problem : problems.all()) INFO(to_string(problem));
  REQUIRE(problems.all().size() == 1);
  const Problem& problem = problems.all().front();
  REQUIRE(problem.code == code);
  REQUIRE(problem.place.file == "test.toml");
  REQUIRE(problem.place.line == line);
  REQUIRE(problem.field == field);
}

TEST_CASE("M07 an unknown material name is E-REF with the nearest names", "[materials][M07]") {
  const MaterialLibrary library = shipped_library();
  ProblemList problems;
  REQUIRE_FALSE(library.index_of("asfalt_smooth"));
  REQUIRE_FALSE(
      library.find("asfalt_smooth", {"scene.toml", 12, 5}, "runway[0].surface", problems));
  REQUIRE(problems.all().size() == 1);
  const Problem& problem = problems.all().front();
  REQUIRE(problem.code == "E-REF");
  REQUIRE(problem.place.line == 12);
  REQUIRE(problem.value == "\"asfalt_smooth\"");
  REQUIRE(problem.expected.find("nearest are asphalt_smooth,") != std::string::npos);
}

TEST_CASE("M07 bad coefficients are refused by class, with file and line", "[materials][M07]") {
  require_problem(problems_of(material_text("nan", "0", "1")), "E-NONFINITE", 2, "test_grass.a");
  require_problem(problems_of(material_text("0", "inf", "1")), "E-NONFINITE", 3, "test_grass.b");
  require_problem(problems_of(material_text("-0.1", "0", "1")), "E-RANGE", 2, "test_grass.a");
  require_problem(problems_of(material_text("0", "-1e-9", "1")), "E-RANGE", 3, "test_grass.b");
  require_problem(problems_of(material_text("0", "0", "0.5")), "E-RANGE", 4, "test_grass.c");
  require_problem(problems_of(material_text("\"dark\"", "0", "1")), "E-PARSE", 2, "test_grass.a");
}

TEST_CASE("M07 no bad material enters the library behind more problems than are listed",
          "[materials][M07]") {
  std::string text;
  for (std::size_t i = 0; i <= ProblemList::kMost; ++i) {
    std::string material = material_text("-1", "0", "1");
    text += material.replace(1, 10, "grass_" + std::to_string(i));
  }
  const ProblemList problems = problems_of(text);  // a library of none
  CHECK(problems.errors() == ProblemList::kMost + 1);
}

TEST_CASE("M07 a temperature that the medium's model does not know is refused at its line",
          "[materials][M07]") {
  const auto rough = [](const std::string& medium, const std::string& temperature) {
    return "[frozen]\nmodel = \"oh1992\"\nmedium = \"" + medium + "\"\nrms_height_mm = 1\n" +
           temperature + "confidence = \"assumed\"\nsource = \"a test\"\n";
  };
  struct Medium {
    const char *name, *too_cold, *too_warm, *range;
  };
  for (const Medium& medium :
       {Medium{"ice", "-33.2", "5", "-33.15 to 0"}, Medium{"moist_soil", "-1", "41", "0 to 40"},
        Medium{"water", "-21", "61", "-20 to 60"}})
    for (const std::string temperature : {medium.too_cold, medium.too_warm}) {
      const ProblemList problems =
          problems_of(rough(medium.name, "temperature_C = " + temperature + "\n"));
      require_problem(problems, "E-RANGE", 5, "frozen.temperature_C");
      REQUIRE(problems.all().front().expected == medium.range);
    }
  const auto sigma0_of = [&](const std::string& medium, const std::string& temperature) {
    ProblemList problems;
    const MaterialLibrary library =
        MaterialLibrary::from_text(rough(medium, temperature), "test.toml", problems);
    REQUIRE(problems.all().empty());
    return library.curves(SurfaceState::dry, Polarisation::horizontal, 35e9).at(0).sigma0(0.5);
  };
  REQUIRE(sigma0_of("ice", "temperature_C = -33.15\n") > 0.0);
  REQUIRE(sigma0_of("ice", "") == sigma0_of("ice", "temperature_C = 0\n"));
  REQUIRE(sigma0_of("water", "") == sigma0_of("water", "temperature_C = 15\n"));
}

TEST_CASE("M07 an empty table is E-PARSE, a table with one row is a library", "[materials][M07]") {
  const ProblemList empty = problems_of("# nothing\n");
  REQUIRE(empty.all().size() == 1);
  REQUIRE(empty.all().front().code == "E-PARSE");
  REQUIRE(empty.all().front().place.file == "test.toml");
  REQUIRE_FALSE(problems_of(material_text("0.1", "0", "1"), 1).has_errors());
}

TEST_CASE("M07 all problems of a library are reported together", "[materials][M07]") {
  const ProblemList problems =
      problems_of(material_text("nan", "-1", "0", "colour = \"green\"\n") +
                  "[other]\na = 0.1\nfrequency_range_GHz = [40, 30]\nconfidence = \"sure\"\n");
  int nonfinite = 0, range = 0, ref = 0;
  for (const Problem& problem : problems.all()) {
    INFO(to_string(problem));
    REQUIRE(problem.place.line > 0);
    nonfinite += problem.code == "E-NONFINITE" ? 1 : 0;
    range += problem.code == "E-RANGE" ? 1 : 0;
    ref += problem.code == "E-REF" ? 1 : 0;
  }
  REQUIRE(nonfinite == 1);
  REQUIRE(range == 4);  // b, c, reversed range, confidence
  REQUIRE(ref == 8);    // seven missing keys of [other], and "colour"
}

TEST_CASE("A missing library file is E-IO and a broken one E-PARSE", "[materials][library]") {
  ProblemList missing;
  REQUIRE(MaterialLibrary::from_file("/nonexistent/library.toml", missing).size() == 0);
  REQUIRE(missing.all().front().code == "E-IO");
  const ProblemList broken = problems_of("[grass\n");
  REQUIRE(broken.all().size() == 1);
  REQUIRE(broken.all().front().code == "E-PARSE");
}

TEST_CASE("Reflectivity scales with the stated power of frequency", "[materials][library]") {
  ProblemList problems;
  const MaterialLibrary library =
      MaterialLibrary::from_text(material_text("0.1", "0.2", "3"), "test.toml", problems);
  const PhongSurface& row = std::get<PhongSurface>(library[0].model);
  const PhongNrcs scaled = row.at_frequency(140e9);
  // (140 / 35)^0.5 = 2.
  REQUIRE(scaled.a() == Approx(0.2).epsilon(1e-14));
  REQUIRE(scaled.b() == Approx(0.4).epsilon(1e-14));
  REQUIRE(scaled.c() == 3.0);
  REQUIRE(row.at_frequency(35e9).a() == 0.1);
  const auto curves_at = [&](double frequency_Hz) {
    return library.curves(SurfaceState::dry, Polarisation::horizontal, frequency_Hz);
  };
  REQUIRE(curves_at(140e9).at(0).sigma0(0.3) == scaled.sigma0(0.3));
  REQUIRE(tests::refuses([&] { curves_at(0.0); }, ErrorClass::range));
  REQUIRE(tests::refuses([&] { curves_at(std::nan("")); }, ErrorClass::nonfinite));
}

TEST_CASE(
    "A frequency or polarisation outside the material's range is refused, or told when allowed",
    "[materials][library]") {
  ProblemList problems;
  const MaterialLibrary library =
      MaterialLibrary::from_text(material_text("0.1", "0.2", "3"), "test.toml", problems);
  for (const double frequency_Hz : {30e9, 35e9, 40e9})
    library.report_extrapolations(0, Polarisation::horizontal, frequency_Hz, false, problems);
  REQUIRE(problems.all().empty());
  library.report_extrapolations(0, Polarisation::vertical, 76e9, false, problems);
  REQUIRE(problems.all().size() == 2);
  for (const Problem& problem : problems.all()) REQUIRE(problem.code == "E-RANGE");
  REQUIRE(problems.all()[0].value == "76");
  REQUIRE(problems.all()[0].expected.starts_with("30 to 40 (model phong), or allow_extrapolation"));
  REQUIRE(problems.all()[1].value == "VV");
  REQUIRE(problems.all()[1].expected.starts_with("HH (model phong)"));
  ProblemList of_a_call;
  library.report_extrapolations(0, Polarisation::horizontal, 76e9, false, of_a_call, "a word");
  REQUIRE(of_a_call.all().front().expected == "30 to 40 (model phong), or a word");
  ProblemList warnings;
  library.report_extrapolations(0, Polarisation::horizontal, 76e9, true, warnings);
  REQUIRE(warnings.all().size() == 1);
  REQUIRE(warnings.all().front().code == "W-EXTRAPOLATED");
  REQUIRE(warnings.all().front().place.line == 1);
  REQUIRE_FALSE(warnings.has_errors());
}

TEST_CASE("The shipped library holds every material a scene names", "[materials][library]") {
  const MaterialLibrary library = shipped_library();
  for (const char* name :
       {"short_grass", "tall_grass",     "crops",        "forest",      "bare_soil",
        "gravel",      "asphalt_smooth", "asphalt_worn", "concrete",    "paint",
        "snow_dry",    "snow_wet",       "water_calm",   "water_rough", "urban",
        "metal",       "brick",          "wall",         "roof",        "rock"}) {
    INFO(name);
    const std::optional<std::size_t> index = library.index_of(name);
    REQUIRE(index);
    const Material& material = library[*index];
    REQUIRE(material.name == name);
    REQUIRE(material.source.size() > 10);
    REQUIRE(material.note.size() > 10);
    REQUIRE(extrapolations_of(material.model, Polarisation::horizontal, 35e9).empty());
  }
}

TEST_CASE(
    "At approach angles grass is brighter than asphalt, asphalt than concrete, concrete than water",
    "[materials][library]") {
  const MaterialLibrary library = shipped_library();
  const std::vector<NrcsCurve> nrcs =
      library.curves(SurfaceState::dry, Polarisation::horizontal, 35e9);
  for (const double grazing_deg : {2.0, 3.0, 5.0, 10.0}) {
    const double sine = std::sin(grazing_deg * 3.14159265358979 / 180.0);
    double previous = 1e9;
    for (const char* name :
         {"short_grass", "asphalt_worn", "asphalt_smooth", "concrete", "water_calm"}) {
      INFO(name << " at " << grazing_deg << " deg");
      const double sigma0 = nrcs[*library.index_of(name)].sigma0(sine);
      REQUIRE(sigma0 < previous / 1.5);  // at least 1.8 dB apart: eight grey levels
      previous = sigma0;
    }
  }
}

}  // namespace
}  // namespace fanbeam::materials
