#include "terrain/buildings/footprints.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "tests/processor_time.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::terrain {
namespace {

using Catch::Matchers::Contains;
using tests::TemporaryFolder;

std::string feature(const std::string& properties, const std::string& type,
                    const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

const std::string kSquare = "[[[11,47],[11.002,47],[11.002,47.002],[11,47.002],[11,47]]]";

double signed_area_deg2(const GeodeticRing& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const GeodeticPoint& a = ring[i];
    const GeodeticPoint& b = ring[(i + 1) % ring.size()];
    twice += a.longitude_rad * b.latitude_rad - b.longitude_rad * a.latitude_rad;
  }
  return core::degrees(core::degrees(0.5 * twice));
}

std::vector<Footprint> read(const std::string& text, core::ProblemList& problems,
                            const FootprintOptions& options = {}) {
  const TemporaryFolder folder;
  return read_footprints(folder.write("buildings.geojson", text), options, problems);
}

std::string refusal_of_geojson(const std::string& text) {
  core::ProblemList problems;
  try {
    read(text, problems);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string warnings_of(const core::ProblemList& problems) {
  std::string text;
  for (const core::Problem& problem : problems.all()) text += core::to_string(problem) + "\n";
  return text;
}

}  // namespace

TEST_CASE("Courtyards stay and rings get their direction", "[footprints]") {
  // Outer ring clockwise and hole counter-clockwise, the wrong way round for RFC 7946.
  const std::string with_hole =
      "[[[11,47],[11,47.004],[11.004,47.004],[11.004,47],[11,47]],"
      "[[11.001,47.001],[11.002,47.001],[11.002,47.002],[11.001,47.002],[11.001,47.001]]]";
  core::ProblemList problems;
  const auto footprints = read(
      collection(feature(R"("render_height":12.5,"render_min_height":3)", "Polygon", with_hole)),
      problems);
  REQUIRE(footprints.size() == 1);
  const Footprint& footprint = footprints.front();
  CHECK(footprint.height_m == 12.5);
  CHECK(footprint.min_height_m == 3.0);
  CHECK(footprint.outer.size() == 4);
  CHECK(signed_area_deg2(footprint.outer) == Approx(16e-6));
  REQUIRE(footprint.holes.size() == 1);
  CHECK(signed_area_deg2(footprint.holes.front()) == Approx(-1e-6));
  CHECK(problems.all().empty());
}

TEST_CASE("Parts of a multi-polygon become footprints of one feature", "[footprints]") {
  const std::string two = "[" + kSquare + ",[[[12,47],[12.001,47],[12.001,47.001],[12,47]]]]";
  core::ProblemList problems;
  const auto footprints =
      read(collection(feature(R"("render_height":5)", "Polygon", kSquare) + "," +
                      feature(R"("render_height":9)", "MultiPolygon", two)),
           problems);
  REQUIRE(footprints.size() == 3);
  CHECK(footprints[0].feature == 0);
  CHECK(footprints[1].feature == 1);
  CHECK(footprints[2].feature == 1);
  CHECK(footprints[2].height_m == 9.0);
  CHECK(footprints[2].outer.size() == 3);
}

// One of them refused the file, without a word where.
TEST_CASE("Rings that do not end where they begin are closed and counted", "[footprints]") {
  const std::string open =
      "[[[11,47],[11.002,47],[11.002,47.002],[11,47.002]],"
      "[[11.0005,47.0005],[11.001,47.0005],[11.001,47.001]]]";
  core::ProblemList problems;
  const auto footprints = read(collection(feature(R"("render_height":5)", "Polygon", kSquare) +
                                          "," + feature(R"("render_height":9)", "Polygon", open)),
                               problems);
  REQUIRE(footprints.size() == 2);
  CHECK(footprints[1].outer.size() == 4);
  CHECK(signed_area_deg2(footprints[1].outer) == Approx(4e-6));
  REQUIRE(footprints[1].holes.size() == 1);
  CHECK(signed_area_deg2(footprints[1].holes[0]) == Approx(-0.125e-6));
  CHECK_THAT(warnings_of(problems),
             Contains("W-UNCLOSED rings that do not end where they begin = 2"));
}

// One of them refused the file as well.
TEST_CASE("Rings of a single position are no footprints and no courtyards", "[footprints]") {
  const std::string square = kSquare.substr(1, kSquare.size() - 2);
  const std::string one = "[[11.001,47.001]]", twice = "[[11.001,47.001],[11.001,47.001]]";
  const auto polygon = [](const std::string& rings) {
    return feature(R"("render_height":9)", "Polygon", "[" + rings + "]");
  };
  core::ProblemList problems;
  const auto footprints = read(
      collection(polygon(square + "," + one +
                         ",[[11.0005,47.0005],[11.001,47.0005],[11.001,47.001],"
                         "[11.0005,47.0005]]," +
                         twice) +
                 "," + polygon(one) + "," + polygon(twice) + "," + polygon(one + "," + square)),
      problems);
  REQUIRE(footprints.size() == 1);
  CHECK(footprints[0].feature == 0);
  CHECK(signed_area_deg2(footprints[0].outer) == Approx(4e-6));
  REQUIRE(footprints[0].holes.size() == 1);
  CHECK(signed_area_deg2(footprints[0].holes[0]) == Approx(-0.125e-6));
  CHECK_THAT(warnings_of(problems), Contains("W-DEGENERATE footprints without area or height = 3"));
}

TEST_CASE("Rings that touch or cross themselves are repaired and counted", "[footprints]") {
  // A square whose outline pinches to a point on its own edge, and a bow tie of two triangles.
  const std::string pinched =
      "[[[11,47],[11.002,47],[11.004,47],[11.004,47.004],[11,47.004],[11,47],"
      "[11.001,47.002],[11.002,47.002],[11,47]]]";
  const std::string bow_tie = "[[[11,47],[11.002,47.002],[11.002,47],[11,47.002],[11,47]]]";
  core::ProblemList problems;
  const auto footprints =
      read(collection(feature(R"("render_height":5)", "Polygon", pinched) + "," +
                      feature(R"("render_height":6)", "Polygon", bow_tie)),
           problems);
  double pinched_area = 0.0;
  double bow_tie_area = 0.0;
  for (const Footprint& footprint : footprints) {
    double& area = footprint.feature == 0 ? pinched_area : bow_tie_area;
    area += signed_area_deg2(footprint.outer);
    for (const GeodeticRing& hole : footprint.holes) area += signed_area_deg2(hole);
  }
  CHECK(pinched_area == Approx(16e-6 - 1e-6));
  CHECK(bow_tie_area == Approx(2e-6));
  CHECK_THAT(warnings_of(problems), Contains("W-REPAIRED") && Contains("= 2"));
}

// Every edge of such a star crosses nearly every other: 12 kB kept the repair busy for minutes.
TEST_CASE("An outline tangled beyond use is E-LIMIT at once", "[footprints]") {
  const auto star = [](int points) {
    std::string ring;
    for (int i = 0; i <= points; ++i) {
      const double angle_rad = core::kPi * (i % points) * (points - 1) / points;
      ring += (i > 0 ? ",[" : "[") + std::to_string(11.0 + 0.001 * std::cos(angle_rad)) + "," +
              std::to_string(47.0 + 0.001 * std::sin(angle_rad)) + "]";
    }
    return collection(feature(R"("render_height":5)", "Polygon", "[[" + ring + "]]"));
  };
  const double begin_s = tests::processor_time_s();
  CHECK_THAT(refusal_of_geojson(star(501)),
             Contains("E-LIMIT feature 0 outline = crosses itself more"));
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
  CHECK(refusal_of_geojson(star(21)) == "accepted");
}

// A spiral of 20 000 corners kept the roof's triangulation busy for minutes.
TEST_CASE("Outlines with too many corners are E-LIMIT, one alone and all together",
          "[footprints]") {
  const auto round = [](int points) {
    std::string ring;
    for (int i = 0; i <= points; ++i) {
      const double angle_rad = 2.0 * core::kPi * (i % points) / points;
      ring += (i > 0 ? ",[" : "[") + std::to_string(11.0 + 0.1 * std::cos(angle_rad)) + "," +
              std::to_string(47.0 + 0.1 * std::sin(angle_rad)) + "]";
    }
    return feature(R"("render_height":5)", "Polygon", "[[" + ring + "]]");
  };
  CHECK_THAT(refusal_of_geojson(collection(round(4001))),
             Contains("E-LIMIT feature 0 corners = 4001: expected at most 4000"));
  CHECK(refusal_of_geojson(collection(round(4000))) == "accepted");
  CHECK_THAT(refusal_of_geojson(collection(round(4000) + "," + round(4000))),
             Contains("E-LIMIT feature 1 corners = 4000"));
}

TEST_CASE("Missing heights, other shapes and empty footprints are counted", "[footprints]") {
  const std::string line = R"([[11,47],[11.1,47.1]])";
  const std::string flat = "[[[11,47],[11.001,47],[11.002,47],[11,47]]]";
  FootprintOptions options;
  options.height_property = "height";
  options.default_height_m = 7.0;
  core::ProblemList problems;
  const auto footprints =
      read(collection(feature("", "Polygon", kSquare) + "," +
                      feature(R"("height":null)", "Polygon", kSquare) + "," +
                      feature(R"("height":"8.5")", "Polygon", kSquare) + "," +
                      feature(R"("height":3)", "LineString", line) + "," +
                      feature(R"("height":3)", "Polygon", flat) + "," +
                      feature(R"("height":3,"render_min_height":3)", "Polygon", kSquare)),
           problems, options);
  REQUIRE(footprints.size() == 3);
  CHECK(footprints[0].height_m == 7.0);
  CHECK(footprints[1].height_m == 7.0);
  CHECK(footprints[2].height_m == 8.5);
  CHECK_THAT(warnings_of(problems),
             Contains("W-DEFAULT features without height = 2: 7 m is used") &&
                 Contains("W-SKIPPED features that are no polygons = 1") &&
                 Contains("W-DEGENERATE footprints without area or height = 2"));
}

// OpenMapTiles, layers/building/building.yaml: "building outlines are marked as hide_3d". They hid their parts.
TEST_CASE("Outlines that are not to be drawn beside their parts are left out", "[footprints]") {
  const auto hidden = [](const std::string& value) {
    return feature(R"("render_height":40,"hide_3d":)" + value, "Polygon", kSquare);
  };
  for (const char* yes : {"true", "1", "\"true\""}) {
    CAPTURE(yes);
    core::ProblemList problems;
    const auto footprints = read(collection(hidden(yes) + "," + hidden("null") + "," +
                                            feature(R"("render_height":8)", "Polygon", kSquare)),
                                 problems);
    REQUIRE(footprints.size() == 2);
    CHECK(footprints[1].height_m == 8.0);
    CHECK_THAT(warnings_of(problems), Contains("W-SKIPPED features with hide_3d = 1: left out"));
  }
  core::ProblemList problems;
  CHECK(read(collection(hidden("false") + "," + hidden("false")), problems).size() == 2);
  CHECK(problems.all().empty());
}

TEST_CASE("Where no feature has the height property, the properties there are told",
          "[footprints]") {
  core::ProblemList problems;
  read(feature(R"("name":"hangar","building_height":12)", "Polygon", kSquare), problems);
  CHECK_THAT(warnings_of(problems),
             Contains("W-DEFAULT features without render_height = 1") &&
                 Contains("m is used; perhaps building_height of building_height, name"));
}

TEST_CASE("Every bad height and coordinate is reported at once", "[footprints]") {
  const std::string off_earth = "[[[11,47],[11.1,97],[11.1,47],[11,47]]]";
  const std::string overflow = "[[[11,47],[1e999,47],[11.1,47.1],[11,47]]]";
  const std::string text =
      refusal_of_geojson(collection(feature(R"("render_height":"12 m")", "Polygon", kSquare) + "," +
                                    feature(R"("render_height":-3)", "Polygon", kSquare) + "," +
                                    feature(R"("render_height":5)", "Polygon", off_earth) + "," +
                                    feature(R"("render_height":5)", "Polygon", overflow)));
  CHECK_THAT(text, Contains("E-RANGE feature 0 render_height = 12 m") &&
                       Contains("E-RANGE feature 1 render_height = -3") &&
                       Contains("E-RANGE feature 2 coordinates") &&
                       Contains("E-RANGE feature 3 coordinates"));
  CHECK_THAT(refusal_of_geojson(collection(feature(R"("render_height":true)", "Polygon", kSquare))),
             Contains("E-PARSE feature 0 render_height = true"));
}

TEST_CASE("Coordinates of another system are converted", "[footprints]") {
  // Web Mercator: x = R longitude with R = 6378137 m; the equator has y = 0.
  const std::string square =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3857"}},)"
      R"("features":[)" +
      feature(R"("render_height":5)", "Polygon",
              "[[[1224000,0],[1224100,0],[1224100,100],[1224000,100],[1224000,0]]]") +
      "]}";
  core::ProblemList problems;
  const auto footprints = read(square, problems);
  REQUIRE(footprints.size() == 1);
  double west_rad = 10.0;
  for (const GeodeticPoint& point : footprints.front().outer)
    west_rad = std::min(west_rad, point.longitude_rad);
  CHECK(west_rad == Approx(1224000.0 / 6378137.0).epsilon(1e-12));
}

TEST_CASE("Positions beyond their reference system are refused, where GDAL would not end",
          "[footprints]") {
  const auto mercator = [](const std::string& type, const std::string& coordinates) {
    return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3857"}},)"
           R"("features":[)" +
           feature(R"("render_height":5)", type, coordinates) + "]}";
  };
  const std::string far = "[[[1e300,0],[1224100,0],[1224100,100],[1e300,0]]]";
  CHECK_THAT(refusal_of_geojson(mercator("Polygon", far)),
             Contains("E-RANGE feature 0 coordinates"));
  CHECK_THAT(refusal_of_geojson(mercator("MultiPolygon", "[" + far + "]")),
             Contains("E-RANGE feature 0 coordinates"));
}

TEST_CASE("Files that are no GeoJSON, cut off, or missing are refused", "[footprints]") {
  const std::string whole = collection(feature(R"("render_height":5)", "Polygon", kSquare) + "," +
                                       feature(R"("render_height":6)", "Polygon", kSquare));
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    CAPTURE(length);
    CHECK_THAT(refusal_of_geojson(whole.substr(0, length)), Contains("E-PARSE"));
  }
  CHECK_THAT(refusal_of_geojson("{\"type\":\"Topology\"}"), Contains("E-PARSE"));
  CHECK_THAT(refusal_of_geojson(std::string(100'000, '[')), Contains("E-PARSE"));
  core::ProblemList problems;
  CHECK_THROWS_WITH(read_footprints("/nonexistent.geojson", {}, problems), Contains("E-IO"));
}

TEST_CASE("Innsbruck's 21,117 footprints are read with their published extent",
          "[footprints][data]") {
  const auto file = tests::shared_data("lowi-innsbruck/buildings.geojson");
  if (!file) return;
  core::ProblemList problems;
  const auto footprints = read_footprints(*file, {}, problems);
  std::set<std::size_t> features;
  std::size_t with_holes = 0;
  double highest_m = 0.0;
  for (const Footprint& footprint : footprints) {
    features.insert(footprint.feature);
    with_holes += footprint.holes.empty() ? 0 : 1;
    highest_m = std::max(highest_m, footprint.height_m);
    for (const GeodeticPoint& point : footprint.outer) {
      if (core::degrees(point.latitude_rad) < 47.234 ||
          core::degrees(point.latitude_rad) > 47.286 ||
          core::degrees(point.longitude_rad) < 11.284 ||
          core::degrees(point.longitude_rad) > 11.441)
        FAIL_CHECK("footprint of feature " << footprint.feature << " out of the window");
    }
  }
  INFO(warnings_of(problems) << footprints.size() << " footprints, " << with_holes
                             << " with courtyards");
  // Counted in the file: 21,135 polygons in 21,117 features, 31 with holes. Feature 2060 has height
  // 0, and 7116 ends (4 m) below its beginning (7 m).
  CHECK(features.size() == 21'115);
  CHECK(features.count(2060) + features.count(7116) == 0);
  CHECK(footprints.size() == 21'133);
  CHECK(with_holes == 31);
  REQUIRE(problems.all().size() == 1);
  CHECK_THAT(warnings_of(problems), Contains("W-DEGENERATE") && Contains("= 2: left out"));
  CHECK(highest_m == 59.0);
}

}  // namespace fanbeam::terrain
