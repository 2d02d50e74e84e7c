// [[airport]]: one line of a scene makes the runways, taxiways and lights of public data.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "scenes/airport/apt_dat_outline.h"
#include "scenes/airport/apt_dat_reader.h"
#include "scenes/objects.h"
#include "terrain/geoid.h"
#include "tests/scenes/built_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using scenes::AirportLine;
using tests::TemporaryFolder;

namespace {

using Rows = std::vector<std::vector<std::string_view>>;

scenes::AptOutline outline_of(const Rows& rows) {
  scenes::AptOutline outline;
  core::ProblemList problems;
  for (const auto& row : rows) outline.add(row, {}, problems);
  CHECK(problems.all().empty());
  return outline;
}

double area_deg2(const AirportLine& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const core::Geodetic& a = ring[i];
    const core::Geodetic& b = ring[(i + 1) % ring.size()];
    sum += core::degrees(a.longitude_rad) * core::degrees(b.latitude_rad) -
           core::degrees(b.longitude_rad) * core::degrees(a.latitude_rad);
  }
  return sum / 2;
}

// An airport of a test's own: one runway to the north, a taxiway 60 m wide east of it with a square hole,
// lit on its western side, a PAPI and a VASI.
const std::string kAirport = R"(I
1100 Version

1    328 1 0 TEST Of a test
100 45.00 1 1 0.25 0 2 1 36 52.00000000 010.00000000 100.0 0 3 2 0 0 18 52.01800000 010.00000000 0.0 0 3 0 0 0
110 2 0.25 0.0 Apron
111 52.00200000 010.00400000
111 52.00200000 010.00700000
111 52.00500000 010.00700000
113 52.00500000 010.00400000 102
111 52.00300000 010.00500000
111 52.00400000 010.00500000
111 52.00400000 010.00600000
113 52.00300000 010.00600000
21 52.00270000 009.99940000 2 0.0 3.00 36 PAPI
21 52.01270000 009.99940000 1 180.0 3.00 18 VASI
99
)";

std::string scene_with(const std::string& airport, const std::string& terrain = "",
                       const std::string& datum = "egm96") {
  return R"([scene]
name = "airport"
origin = { latitude_deg = 52.009, longitude_deg = 10.0, height_m = 90.0 }
vertical_datum = ")" +
         datum + R"("
[terrain]
half_extent_m = 3000.0
spacing_m = 20.0
)" + terrain +
         R"(
[[airport]]
file = "apt.dat"
ident = "TEST"
)" + airport +
         R"(
[trajectory.fixed]
at = { latitude_deg = 51.99, longitude_deg = 10.0 }
above_ground_m = 100.0
)";
}

std::size_t count_named(const scenes::Scene& scene, const std::string& name) {
  std::size_t count = 0;
  for (const renderer::PointTarget& target : scene.world.targets) count += target.name == name;
  return count;
}

}  // namespace

TEST_CASE("Curves of apt.dat have the areas of Bezier's formulas", "[airport]") {
  // A square whose last-but-one corner bulges to both sides, quadratic: a parabola over a chord of 1 with its
  // control point 0.5 above holds 1/6, and eight chords of it 63/64 of that.
  const auto quadratic = outline_of(
      {{"111", "0", "0"}, {"111", "0", "1"}, {"112", "1", "1", "1.5", "0.5"}, {"113", "1", "0"}});
  REQUIRE(quadratic.rings().size() == 1);
  CHECK(area_deg2(quadratic.rings()[0]) == Approx(1.0 + 2.0 / 6.0 * 63.0 / 64.0).epsilon(1e-12));
  // Four cubics with handles of 0.5522847 are a circle within 3e-4; eight chords of each cut off what 32 sides do.
  const auto cubic = outline_of({{"112", "-1", "0", "-1", "0.5522847"},
                                 {"112", "0", "1", "0.5522847", "1"},
                                 {"112", "1", "0", "1", "-0.5522847"},
                                 {"114", "0", "-1", "-0.5522847", "-1"}});
  CHECK(area_deg2(cubic.rings().at(0)) == Approx(16.0 * std::sin(core::kPi / 16.0)).epsilon(1e-3));
}

TEST_CASE("Rows that hold no corner are told with their line, and open lines close no ring",
          "[airport]") {
  scenes::AptOutline outline;
  core::ProblemList problems;
  outline.add({"111", "1"}, {"apt.dat", 7}, problems);
  outline.add({"112", "91", "0", "x", "0"}, {"apt.dat", 8}, problems);
  outline.add({"115", "1", "1"}, {"apt.dat", 9}, problems);
  REQUIRE(problems.all().size() == 3);
  CHECK(core::to_string(problems.all()[0]).starts_with("apt.dat:7: E-PARSE row 111"));
  CHECK(core::to_string(problems.all()[1]).starts_with("apt.dat:8: E-RANGE row 112"));
  CHECK(core::to_string(problems.all()[2]).starts_with("apt.dat:8: E-PARSE row 112"));
  CHECK(outline.rings().empty());
}

TEST_CASE("An airport of apt.dat is one line of a scene: runway, apron with its hole, lights",
          "[airport]") {
  const TemporaryFolder folder;
  folder.write("apt.dat", kAirport);
  const auto scene = tests::good_scene(folder, scene_with(""));
  // On the plain at the airport's elevation, 328 ft above the sea.
  const auto at = [&](double latitude_deg, double longitude_deg) {
    return tests::seen_from_above(*scene, tests::local_m(*scene, latitude_deg, longitude_deg))
        .material;
  };
  CHECK(at(52.0100, 10.0003) == "asphalt_worn");
  CHECK(at(52.0025, 10.0055) == "concrete");
  CHECK(at(52.0035, 10.0045) == "concrete");
  CHECK(at(52.0035, 10.0055) == "short_grass");  // the hole
  CHECK(at(52.0060, 10.0055) == "short_grass");
  const double elevation_m = 328.0 * 0.3048;
  const glm::dvec2 middle = tests::local_m(*scene, 52.0100, 10.0003);
  CHECK(tests::height_m(*scene, middle) -
            terrain::ellipsoidal_height_m({core::radians(52.01), core::radians(10.0), 0.0},
                                          core::VerticalDatum::egm96) ==
        Approx(elevation_m).epsilon(0.0).margin(0.05));
  // 333.8 m of lit edge: a light every 40 m.
  CHECK(count_named(*scene, "taxiway light") == 9);
  CHECK(count_named(*scene, "PAPI") == 4);
  // 900 m of barrettes before threshold 36, none before 18.
  std::size_t south = 0, north = 0;
  for (const renderer::PointTarget& target : scene->world.targets)
    if (target.name == "approach light")
      (target.position_at(0.0).y < middle.y ? south : north) += 1;
  CHECK(south > 100);
  CHECK(north == 0);
  const auto& names = scene->world.geometry->object_names;
  CHECK(std::count(names.begin(), names.end(), "runway 36/18") == 1);
  CHECK(std::count(names.begin(), names.end(), "pavement 1") == 1);
}

// They went without a word.
TEST_CASE("Pavements that cannot be laid are told by their row", "[airport]") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& airport) {
    folder.write("apt.dat", airport);
    std::string text;
    for (const core::Problem& problem : tests::build_text(folder, scene_with("")).problems)
      text += core::to_string(problem) + "\n";
    return text;
  };
  CHECK_THAT(told(kAirport), !Catch::Contains("SKIPPED pavement"));
  const std::string end_of_hole = "113 52.00300000", end_of_outline = "113 52.00500000";
  const std::string open_hole = tests::replaced(kAirport, end_of_hole, "111 52.00300000");
  CHECK_THAT(told(open_hole),
             Catch::Contains("apt.dat:6: W-SKIPPED pavement = a ring that no row"));
  // Of both a single ring is left, which nothing closes.
  CHECK_THAT(told(tests::replaced(open_hole, end_of_outline, "111 52.00500000")),
             Catch::Contains("apt.dat:6: W-SKIPPED pavement = a ring that no row"));
  CHECK_THAT(
      told(tests::replaced(kAirport, "110 2 0.25 0.0 Apron", "110 2 0.25 0.0 A\n110 2 0.25 0.0 B")),
      Catch::Contains("apt.dat:6: W-SKIPPED pavement = no ring of three corners"));
  CHECK_THAT(told(tests::replaced(kAirport, "010.00700000", "030.00700000")),
             Catch::Contains("apt.dat:6: W-SKIPPED pavement = a corner more than 1000 km"));
  std::string many;
  for (std::size_t i = 4; i <= scenes::kMostPavementCorners; ++i)
    many += "111 52.00200000 010.00400000\n";
  CHECK_THAT(told(tests::replaced(kAirport, "111 52.00200000 010.00700000\n",
                                  "111 52.00200000 010.00700000\n" + many)),
             Catch::Contains("apt.dat:6: E-LIMIT pavement = 50005 corners"));
}

TEST_CASE("Curves go the short way over the date line", "[airport]") {
  const auto here = outline_of({{"111", "0", "-0.5"},
                                {"111", "0", "0.5"},
                                {"112", "1", "0.5", "1.5", "0.25"},
                                {"114", "1", "-0.5", "1", "-0.75"}});
  const auto there = outline_of({{"111", "0", "179.5"},
                                 {"111", "0", "-179.5"},
                                 {"112", "1", "-179.5", "1.5", "-179.75"},
                                 {"114", "1", "179.5", "1", "179.25"}});
  REQUIRE(here.rings().at(0).size() == there.rings().at(0).size());
  for (std::size_t i = 0; i < here.rings()[0].size(); ++i) {
    const core::Geodetic &a = here.rings()[0][i], &b = there.rings()[0][i];
    CHECK(b.latitude_rad == Approx(a.latitude_rad).epsilon(0.0).margin(1e-12));
    CHECK(std::abs(b.longitude_rad) <= core::kPi);
    CHECK(std::remainder(b.longitude_rad - a.longitude_rad - core::kPi, 2.0 * core::kPi) ==
          Approx(0.0).epsilon(0.0).margin(1e-12));
  }
}

// The rest of the scene was then placed along no direction: "flight_volume = -nan to -nan".
TEST_CASE("A runway whose ends are one place is told as such, and nothing beside it as no number",
          "[airport][bad_scene]") {
  const TemporaryFolder folder;
  folder.write("apt.dat", tests::replaced(kAirport, "18 52.01800000", "18 52.00000000"));
  const tests::Outcome outcome = tests::build_text(folder, scene_with(""));
  CHECK(outcome.scene == nullptr);
  bool told = false;
  for (const core::Problem& problem : outcome.problems) {
    const std::string text = core::to_string(problem);
    INFO(text);
    CHECK(text.find("nan") == std::string::npos);
    told = told || text.find("E-RANGE runway length = 0 m") != std::string::npos;
  }
  CHECK(told);
}

TEST_CASE("An end without an elevation lies on the line that the elevation data come nearest to",
          "[airport]") {
  const TemporaryFolder folder;
  folder.write("apt.dat", kAirport);
  // Rising 20 m per 0.018 deg to the north from 80 m at the southern end, +-1.5 m in a checker board.
  tests::AsciiGrid grid;
  grid.columns = 250, grid.rows = 200, grid.west = 9.9, grid.south = 51.95, grid.cell = 0.0008;
  grid.write(folder, "dem", [&](int column, int row) {
    return std::to_string(80.0 + (grid.post_y(row) - 52.0) / 0.018 * 20.0 +
                          ((row + column) % 2 == 0 ? 1.5 : -1.5));
  });
  for (const char* datum : {"egm96", "ellipsoid"}) {
    const auto scene = tests::good_scene(folder, scene_with("", "elevation = \"dem.asc\"", datum));
    REQUIRE(scene->runways.size() == 1);
    for (const int end : {0, 1}) {
      const glm::dvec3 at = scene->runways[0].ends[end].pavement_end_m;
      core::Geodetic geodetic = scene->frame.to_geodetic(at);
      if (std::string(datum) == "egm96")
        geodetic.height_m -= terrain::ellipsoidal_height_m(
            {geodetic.latitude_rad, geodetic.longitude_rad, 0.0}, core::VerticalDatum::egm96);
      CHECK(geodetic.height_m == Approx(end == 0 ? 80.0 : 100.0).epsilon(0.0).margin(0.3));
    }
  }
}

// Elevations above the sea went into a level that nobody knows: with heights over the ellipsoid 48 m too deep.
TEST_CASE("Where nobody knows the scene's level an airport's ends lie on its ground", "[airport]") {
  const TemporaryFolder folder;
  folder.write("apt.csv",
               "airport,runway_end,end_lat_deg,end_lon_deg,end_elevation_m_msl,width_m,surface\n"
               "TEST,36,52.0,10.0,35,45,ASP\nTEST,18,52.018,10.0,55,45,ASP\n");
  tests::AsciiGrid grid;
  grid.columns = 250, grid.rows = 200, grid.west = 9.9, grid.south = 51.95, grid.cell = 0.0008;
  grid.write(folder, "dem", [&](int, int row) {
    return std::to_string(80.0 + (grid.post_y(row) - 52.0) / 0.018 * 20.0);
  });
  const auto text = [](const std::string& terrain) {
    return tests::replaced(scene_with("", terrain, "scene"), "apt.dat", "apt.csv");
  };
  const auto scene = tests::good_scene(folder, text("elevation = \"dem.asc\""));
  REQUIRE(scene->runways.size() == 1);
  for (const int end : {0, 1})
    CHECK(scene->frame.to_geodetic(scene->runways[0].ends[end].pavement_end_m).height_m ==
          Approx(end == 0 ? 80.0 : 100.0).epsilon(0.0).margin(0.3));
  const tests::Outcome plain = tests::build_text(folder, text(""));
  CHECK(plain.scene == nullptr);
  std::string told;
  for (const core::Problem& problem : plain.problems) told += core::to_string(problem) + "\n";
  CHECK_THAT(told, Catch::Contains("E-RANGE airport[0].file = elevations above mean sea level") &&
                       Catch::Contains("count from an unknown level"));
}

// A scene of one runway of a large airport could not be made: PAPI of the others were errors.
TEST_CASE("A PAPI beyond the terrain is left out as lights are", "[airport]") {
  const TemporaryFolder folder;
  folder.write("apt.dat", tests::replaced(kAirport, "21 52.00270000 009.99940000 2",
                                          "21 52.00270000 009.90000000 2"));
  const auto scene = tests::good_scene(folder, scene_with(""));
  CHECK(count_named(*scene, "PAPI") == 0);
  CHECK(count_named(*scene, "taxiway light") == 9);
}

TEST_CASE("What an airport's line leaves out or has wrong", "[airport]") {
  const TemporaryFolder folder;
  folder.write("apt.dat", kAirport);
  const auto bare =
      tests::good_scene(folder, scene_with("runways = [\"18\"]\ntaxiways = false\npapi = false"));
  CHECK(count_named(*bare, "taxiway light") == 0);
  CHECK(count_named(*bare, "PAPI") == 0);
  CHECK(bare->runways.size() == 1);
  const auto told = [&](const std::string& text, const std::string& problem) {
    const tests::Outcome outcome = tests::build_text(folder, text);
    CHECK(outcome.scene == nullptr);
    bool found = false;
    for (const core::Problem& each : outcome.problems)
      found = found || core::to_string(each).find(problem) != std::string::npos;
    INFO(problem);
    CHECK(found);
  };
  told(scene_with("runways = [\"09\"]"),
       "E-REF airport[0].runways = \"09\": expected ends of TEST's runways, 36/18");
  told(tests::replaced(scene_with(""), "\"TEST\"", "\"TESS\""), "nearest: TEST");
  folder.write("apt.csv",
               "airport,runway_end,end_lat_deg,end_lon_deg,width_m,surface\n"
               "TEST,36,52.0,10.0,45,ASP\nTEST,18,52.018,10.0,45,ASP\n");
  told(tests::replaced(scene_with(""), "apt.dat", "apt.csv"), "no elevation of 36");
  folder.write("apt.dat", tests::replaced(kAirport, "010.00000000 100.0 0", "010.00000000 1950 0"));
  told(scene_with(""),
       "apt.dat:5: E-RANGE displaced thresholds = 1950 m together: expected at least 100 m of");
}

TEST_CASE("Airports of the sample of X-Plane's gateway become scenes, every pavement of theirs",
          "[airport][data]") {
  const auto path = tests::shared_data("apt-dat-sample/apt.dat");
  if (!path) return;
  struct Sample {
    const char* ident;
    double latitude_deg, longitude_deg;
    std::size_t runways, pavements, papis;
  };
  // Rows 100 and 110 of each, counted in the file; KBJC 39.9088 N 105.1172 W, LELL 41.5209 N 2.1051 E.
  for (const Sample& sample :
       {Sample{"KBJC", 39.9088, -105.1172, 3, 18, 0}, Sample{"LELL", 41.5209, 2.1051, 1, 37, 2}}) {
    INFO(sample.ident);
    core::ProblemList problems;
    const auto airport = scenes::read_apt_dat(*path, sample.ident, problems);
    REQUIRE(airport);
    CHECK(airport->runways.size() == sample.runways);
    CHECK(airport->pavements.size() == sample.pavements);
    const TemporaryFolder folder;
    std::filesystem::copy_file(*path, folder.path() / "apt.dat");
    std::string text = scene_with("");
    text = tests::replaced(text, "TEST", sample.ident);
    text = tests::replaced(text, "latitude_deg = 52.009, longitude_deg = 10.0",
                           "latitude_deg = " + std::to_string(sample.latitude_deg) +
                               ", longitude_deg = " + std::to_string(sample.longitude_deg));
    text = tests::replaced(text, "latitude_deg = 51.99, longitude_deg = 10.0",
                           "latitude_deg = " + std::to_string(sample.latitude_deg) +
                               ", longitude_deg = " + std::to_string(sample.longitude_deg));
    const auto scene = tests::good_scene(folder, text);
    CHECK(scene->runways.size() == sample.runways);
    CHECK(count_named(*scene, "PAPI") == 4 * airport->papis.size());
    CHECK(airport->papis.size() >= sample.papis);
    const auto& names = scene->world.geometry->object_names;
    const auto pavements = static_cast<std::size_t>(
        std::count_if(names.begin(), names.end(),
                      [](const std::string& name) { return name.starts_with("pavement"); }));
    CHECK(pavements >= sample.pavements);
  }
}
