// The shipped typical objects, computed again, and what is told about bad libraries.
#include "materials/rcs/object_library.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "core/constants.h"
#include "core/units.h"
#include "tests/decibel.h"
#include "tests/materials/ka_radar.h"

namespace fanbeam::materials {
namespace {

using core::kPi;
using core::radians;
using tests::dB;
using tests::kLambda_m;

ObjectLibrary shipped_objects() {
  core::ProblemList problems;
  ObjectLibrary library = ObjectLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/objects.toml", problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(problems.all().empty());
  return library;
}

const TypicalObject& object(const ObjectLibrary& library, const std::string& name) {
  core::ProblemList problems;
  const TypicalObject* found = library.find(name, {}, "test", problems);
  REQUIRE(found != nullptr);
  return *found;
}

// Mean of a shape's cross-section while it leans evenly over `lean_deg` about broadside: what the
// notes of built objects say in closed form. Steps far below the lobe's width.
double mean_over_lean_m2(const RcsModel& shape, double lean_deg) {
  constexpr int kSteps = 200'000;
  double sum_m2 = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double e_rad = radians(lean_deg) * ((i + 0.5) / kSteps - 0.5);
    sum_m2 += rcs_m2(shape, {std::cos(e_rad), 0.0, std::sin(e_rad)}, kLambda_m);
  }
  return sum_m2 / kSteps;
}

// The same for a plate over both angles, which its formula keeps apart near its normal.
double mean_over_plate_m2(const RectangularPlate& plate, double azimuth_deg, double lean_deg) {
  const double peak_m2 = rcs_m2(plate, {1.0, 0.0, 0.0}, kLambda_m);
  constexpr int kSteps = 200'000;
  double across = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double a_rad = radians(azimuth_deg) * ((i + 0.5) / kSteps - 0.5);
    if (std::abs(a_rad) < kPi / 2.0)
      across += rcs_m2(plate, {std::cos(a_rad), std::sin(a_rad), 0.0}, kLambda_m) / peak_m2;
  }
  return across / kSteps * mean_over_lean_m2(plate, lean_deg);
}

TEST_CASE("Every object that we built follows from the shapes in its note",
          "[materials][objects]") {
  const ObjectLibrary library = shipped_objects();
  const double w = radians(10.0);
  const double sphere_m2 = rcs_m2(Sphere{0.1}, {1, 0, 0}, kLambda_m);
  struct Built {
    const char* name;
    double closed_form_m2, from_shapes_m2;
  };
  const auto body = [](double l, double b, double h, double lean_deg) {
    return 2.0 * mean_over_plate_m2({l, h}, 360.0, lean_deg) +
           2.0 * mean_over_plate_m2({b, h}, 360.0, lean_deg);
  };
  const std::vector<Built> all = {
      {"fence_post", kPi * 0.03 * 2.4 / w, mean_over_lean_m2(Cylinder{0.03, 2.4}, 10.0)},
      {"metal_pole", kPi * 0.06 * 6.0 / w, mean_over_lean_m2(Cylinder{0.06, 6.0}, 10.0)},
      {"signpost", 0.8 * 0.6 / w + kPi * 0.03 * 2.0 / w,
       2.0 * mean_over_plate_m2({0.8, 0.6}, 360.0, 10.0) +
           mean_over_lean_m2(Cylinder{0.03, 2.0}, 10.0)},
      {"papi_unit", kPi * 0.7 * 0.25 / (radians(30.0) * w),
       mean_over_plate_m2({0.7, 0.25}, 30.0, 10.0)},
      {"approach_light", kPi * 0.01 + kPi * 0.015 * 0.3 / w,
       sphere_m2 + mean_over_lean_m2(Cylinder{0.015, 0.3}, 10.0)},
      {"truck", (27.0 + 6.75) / w, body(10.0, 2.5, 2.7, 10.0)},
      {"bus", (36.0 + 7.65) / radians(20.0), body(12.0, 2.55, 3.0, 20.0)}};
  std::set<std::string> built;
  for (const Built& b : all) {
    INFO(b.name);
    built.insert(b.name);
    const TypicalObject& o = object(library, b.name);
    CHECK(dB(o.mean_rcs_m2) == Approx(dB(b.closed_form_m2)).epsilon(0.0).margin(0.006));
    // Side lobes beyond the spread are what the closed form adds.
    CHECK(dB(b.from_shapes_m2) == Approx(dB(b.closed_form_m2)).epsilon(0.0).margin(0.15));
    CHECK(o.confidence == Confidence::assumed);
  }
  for (const TypicalObject& o : library.all())
    if (o.source.starts_with("built")) CHECK(built.count(o.name) == 1);
}

TEST_CASE("Published objects have their published figures", "[materials][objects]") {
  const ObjectLibrary library = shipped_objects();
  // 3GPP TR 38.901 release 19, 7.9.2: mean in dBsm, standard deviation in dB.
  const std::map<std::string, std::pair<double, double>> rows = {{"person", {-1.37, 3.94}},
                                                                 {"car", {11.25, 3.41}},
                                                                 {"small_drone", {-12.81, 3.74}},
                                                                 {"large_drone", {-5.85, 2.5}},
                                                                 {"cart", {-4.25, 2.51}}};
  for (const auto& [name, figures] : rows) {
    const TypicalObject& o = object(library, name);
    CHECK(dB(o.mean_rcs_m2) == Approx(figures.first).epsilon(0.0).margin(1e-9));
    CHECK(o.spread_dB == figures.second);
  }
  // Britannica: 2 m2, and 10 to 100 m2, of which the geometric mean.
  CHECK(object(library, "light_aircraft").mean_rcs_m2 == Approx(2.0).epsilon(1e-3));
  CHECK(object(library, "airliner").mean_rcs_m2 == Approx(std::sqrt(1000.0)).epsilon(1e-3));
  CHECK(object(library, "foreign_object").mean_rcs_m2 == Approx(0.01));
  for (const TypicalObject& o : library.all()) {
    INFO(o.name);
    CHECK_FALSE(o.source.empty());
    CHECK(o.frequency_range_Hz.low < o.frequency_range_Hz.high);
    CHECK_NOTHROW(check_rcs_model(o.rcs()));
  }
}

TEST_CASE(
    "A car is brightest from the side, has its floor between the lobes, and averages to its "
    "published mean",
    "[materials][objects]") {
  const RcsModel car = object(shipped_objects(), "car").rcs();
  const auto level = [&](double azimuth_deg, double elevation_deg) {
    const double a = radians(azimuth_deg);
    const double e = radians(elevation_deg);
    return dB(rcs_m2(car, {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)},
                     kLambda_m));
  };
  // TR 38.901 table 7.9.2.1-4: peaks, half power at half the 3 dB width, floor.
  CHECK(level(0.0, 18.25) == Approx(15.52).epsilon(0.0).margin(1e-9));
  CHECK(level(90.0, 10.3) == Approx(20.75).epsilon(0.0).margin(1e-9));
  CHECK(level(-90.0, 10.3) == Approx(20.75).epsilon(0.0).margin(1e-9));
  CHECK(level(180.0, 10.35) == Approx(14.56).epsilon(0.0).margin(1e-9));
  CHECK(level(-179.9999, 10.35) == Approx(14.56).epsilon(0.0).margin(1e-6));
  CHECK(level(33.0, 90.0) == Approx(21.26).epsilon(0.0).margin(1e-9));
  CHECK(level(90.0 + 26.9 / 2.0, 10.3) == Approx(20.75 - 3.0).epsilon(0.0).margin(1e-9));
  CHECK(level(90.0, 10.3 + 44.42 / 2.0) == Approx(20.75 - 3.0).epsilon(0.0).margin(1e-9));
  CHECK(level(45.0, 10.0) == Approx(7.07).epsilon(0.0).margin(1e-9));
  // Mean of the linear value over the directions from which a radar looks, up to 30 deg.
  double sum_m2 = 0.0;
  double weight = 0.0;
  for (double e = -30.0; e <= 30.0; e += 1.0)
    for (double a = 0.0; a < 360.0; a += 1.0) {
      sum_m2 += std::cos(radians(e)) * std::pow(10.0, 0.1 * level(a, e));
      weight += std::cos(radians(e));
    }
  CHECK(dB(sum_m2 / weight) == Approx(11.25).epsilon(0.0).margin(2.0));
}

TEST_CASE("A bad object library is told about at once, row by row", "[materials][objects]") {
  core::ProblemList problems;
  const ObjectLibrary library = ObjectLibrary::from_text(R"([good]
rcs_dBsm = 0.0
spread_dB = 0.0
fluctuation = 0
frequency_range_GHz = [1, 100]
size_m = [1, 1, 1]
confidence = "seen"
source = "a test"

[bad]
rcs_dBsm = 90.0
spread_dB = -1.0
fluctuation = 5
frequency_range_GHz = [100, 1]
size_m = [1, 1]
confidence = "sure"
colour = "red"

[[bad.lobe]]
peak_dBsm = 3.0
)",
                                                         "objects.toml", problems);
  REQUIRE(library.all().size() == 1);
  CHECK(library.all()[0].name == "good");
  std::vector<std::string> fields;
  for (const core::Problem& problem : problems.all())
    fields.push_back(problem.code + " " + problem.field);
  for (const char* expected :
       {"E-RANGE bad.rcs_dBsm", "E-RANGE bad.spread_dB", "E-RANGE bad.fluctuation",
        "E-RANGE bad.frequency_range_GHz", "E-REF bad.source", "E-REF bad.floor_dBsm",
        "E-REF bad.lobe[0].elevation_deg", "E-REF bad.lobe[0].elevation_width_deg",
        "E-RANGE bad.confidence", "E-REF bad.colour"}) {
    INFO(expected);
    CHECK(std::count(fields.begin(), fields.end(), expected) == 1);
  }
  CHECK(std::any_of(fields.begin(), fields.end(),
                    [](const std::string& field) { return field.ends_with(" bad.size_m"); }));

  core::ProblemList unknown;
  CHECK(library.find("goof", {}, "target[0].rcs", unknown) == nullptr);
  REQUIRE(unknown.all().size() == 1);
  CHECK(core::to_string(unknown.all()[0]).find("nearest are good") != std::string::npos);

  core::ProblemList empty;
  ObjectLibrary::from_text("", "objects.toml", empty);
  CHECK(empty.has_errors());
}

TEST_CASE("No bad object enters the library behind more problems than are listed",
          "[materials][objects]") {
  std::string text;
  for (std::size_t i = 0; i <= core::ProblemList::kMost; ++i)
    text += "[object_" + std::to_string(i) +
            "]\nrcs_dBsm = 500\nspread_dB = 1\nfluctuation = 0\n"
            "frequency_range_GHz = [30, 40]\nsize_m = [1, 1, 1]\nconfidence = \"assumed\"\n"
            "source = \"a test\"\n";
  core::ProblemList problems;
  const ObjectLibrary library = ObjectLibrary::from_text(text, "objects.toml", problems);
  CHECK(problems.errors() == core::ProblemList::kMost + 1);
  CHECK(library.all().empty());
}

TEST_CASE("Objects used far from where they are known are told about", "[materials][objects]") {
  const ObjectLibrary library = shipped_objects();
  core::ProblemList problems;
  warn_if_extrapolated(object(library, "car"), 35e9, problems);
  CHECK(problems.all().empty());
  warn_if_extrapolated(object(library, "airliner"), 35e9, problems);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "W-EXTRAPOLATED");
  CHECK(problems.all()[0].field == "object 'airliner' at frequency_GHz");
}

}  // namespace
}  // namespace fanbeam::materials
