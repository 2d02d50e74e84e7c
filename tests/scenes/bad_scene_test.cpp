// What shows only when a scene is put together: rasters, runways, objects and flights that do not
// fit.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <regex>
#include <set>
#include <string>

#include "tests/processor_time.h"
#include "tests/scenes/built_scene.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::AsciiGrid;
using tests::check_problems;
using tests::file_trajectory;
using tests::TemporaryFolder;

namespace {

// Posts every 0.002 deg around the scene, all 40 m high.
AsciiGrid grid_around() { return {60, 40, 9.94, 51.96, 0.002}; }

}  // namespace

TEST_CASE("A raster without georeference, a damaged one, one that ends too early", "[bad_scene]") {
  const std::string text =
      tests::replaced(tests::kSmallScene, "material = \"short_grass\"", "elevation = \"dem.asc\"");
  const auto flat = [](int, int) { return "40"; };
  {
    const TemporaryFolder folder;
    AsciiGrid grid = grid_around();
    grid.wkt = "";
    grid.write(folder, "dem", flat);
    check_problems(
        folder, text,
        {"@/scene.toml:9:1: E-REF terrain.elevation = dem.asc, georeference: no "
         "coordinate reference system: expected one in a .prj file beside the grid, of its "
         "name"});
  }
  {
    const TemporaryFolder folder;
    folder.write("dem.asc", "ncols 3\nnrows\n");
    const tests::Outcome outcome = tests::build_text(folder, text);
    REQUIRE(outcome.problems.size() == 1);
    CHECK(outcome.problems[0].code == "E-PARSE");
    CHECK(outcome.problems[0].field == "terrain.elevation");
    CHECK(outcome.problems[0].place.line == 9);
  }
  {
    const TemporaryFolder folder;
    AsciiGrid grid = grid_around();
    grid.south = 51.99;  // the terrain begins 2.5 km south of the origin
    grid.write(folder, "dem", flat);
    const tests::Outcome outcome = tests::build_text(folder, text);
    REQUIRE(outcome.problems.size() == 1);
    CHECK(outcome.problems[0].field == "terrain extent");
    CHECK(outcome.problems[0].value.find("posts without elevation, the first at 51.9775") !=
          std::string::npos);
    CHECK(outcome.problems[0].place.line == 6);
  }
}

TEST_CASE("Voids are counted where the scene rests on them, and told once with their remedy",
          "[bad_scene]") {
  const TemporaryFolder folder;
  const std::string text =
      tests::replaced(tests::kSmallScene, "material = \"short_grass\"", "elevation = \"dem.asc\"");
  const std::string filling = tests::replaced(text, "\"dem.asc\"", "\"dem.asc\"\nvoids = \"fill\"");
  const auto with_void_columns = [&](AsciiGrid grid, const std::set<int>& voids) {
    grid.write(folder, "dem",
               [&](int column, int) { return voids.contains(column) ? "-9999" : "40"; });
  };
  // The scene reaches 2500 m from 52 N, 10 E, and its surface one post beyond the two around a
  // place: columns 10 to 49 and rows 7 to 32.
  with_void_columns(grid_around(), {3, 4, 9, 50});
  const tests::Outcome elsewhere = tests::build_text(folder, text);
  CHECK(elsewhere.scene != nullptr);
  CHECK(elsewhere.problems.empty());

  with_void_columns(grid_around(), {3, 20, 49});
  const std::string found =
      "dem.asc, 52 of the 1040 posts that the scene uses have no height, "
      "the first at column 20, row 7, near 52.0211, 9.9774 deg";
  const tests::Outcome refused = tests::build_text(folder, text);
  REQUIRE(refused.problems.size() == 1);
  const core::Problem& problem = refused.problems[0];
  INFO(core::to_string(problem));
  CHECK(problem.code == "E-RANGE");
  CHECK(problem.field == "terrain.elevation");
  CHECK(problem.place.line == 9);
  CHECK(problem.value.starts_with(found));
  CHECK(problem.expected.find("voids = \"fill\"") != std::string::npos);

  const tests::Outcome filled = tests::build_text(folder, filling);
  CHECK(filled.scene != nullptr);
  REQUIRE(filled.problems.size() == 1);
  CHECK(filled.problems[0].code == "W-VOID");
  CHECK(filled.problems[0].place.line == 9);
  CHECK(filled.problems[0].value.starts_with(found));

  // Beside data that end too early, in one round.
  AsciiGrid short_grid = grid_around();
  short_grid.south = 51.99;
  with_void_columns(short_grid, {20});
  const tests::Outcome both = tests::build_text(folder, text);
  REQUIRE(both.problems.size() == 2);
  CHECK(both.problems[1].field == "terrain.elevation");
  CHECK(both.problems[0].field == "terrain extent");
  CHECK(both.problems[0].value.find("too wide to fill") == std::string::npos);
}

TEST_CASE("A void too wide to fill is told in the same round as the key that does not help",
          "[bad_scene]") {
  const TemporaryFolder folder;
  // 300 posts of 11 m by 7 m: the middle is 150 posts from any height, 50 more than are bridged.
  AsciiGrid{800, 500, 9.96, 51.975, 1e-4}.write(folder, "dem", [](int column, int row) {
    return std::abs(column - 400) < 150 && std::abs(row - 250) < 150 ? "-9999" : "40";
  });
  const std::string text =
      tests::replaced(tests::kSmallScene, "material = \"short_grass\"", "elevation = \"dem.asc\"");
  const tests::Outcome outcome = tests::build_text(folder, text);
  const auto value_of = [&](const std::string& field) {
    for (const core::Problem& problem : outcome.problems)
      if (problem.field == field) return problem.value;
    return std::string();
  };
  CHECK(value_of("terrain.elevation").find(" posts that the scene uses have no height") !=
        std::string::npos);
  CHECK(value_of("terrain extent").find(" in voids too wide to fill)") != std::string::npos);
}

TEST_CASE("Land cover: classes without material, materials that do not exist, no class at all",
          "[bad_scene]") {
  const TemporaryFolder folder;
  grid_around().write(folder, "cover", [](int column, int) { return column < 30 ? "1" : "7"; });
  const auto with_classes = [](const std::string& classes) {
    return tests::replaced(tests::kSmallScene, "material = \"short_grass\"",
                           "land_cover = { file = \"cover.asc\", classes = { " + classes + " } }");
  };
  check_problems(folder, with_classes("1 = \"forest\""),
                 {"@/scene.toml:6:1: E-REF terrain.land_cover.classes = class 7 of the raster has "
                  "no material: expected 7 = "
                  "\"...\""});
  check_problems(folder, with_classes("1 = \"forest\", 7 = \"gras\""),
                 {"@/scene.toml:9:62: E-REF terrain.land_cover.classes.7 = \"gras\": expected a "
                  "material of the library; nearest "
                  "are crops, gravel, urban"});
  check_problems(folder, with_classes("1 = \"forest\", seven = \"crops\""),
                 {"@/scene.toml:9:62: E-PARSE terrain.land_cover.classes.seven = \"seven\": "
                  "expected a class number as the key"});
  check_problems(folder, with_classes("1 = \"forest\", 65536 = \"crops\""),
                 {"@/scene.toml:9:62: E-RANGE terrain.land_cover.classes.65536 = 65536: expected a "
                  "class from 0 to 65535"});
  check_problems(folder, with_classes("1 = \"forest\", 01 = \"crops\", 7 = \"crops\""),
                 {"@/scene.toml:9:62: E-REF terrain.land_cover.classes.01 = 01: expected each "
                  "class once"});
}

TEST_CASE("Runways off the map, too short, named twice, and ends that do not exist",
          "[bad_scene]") {
  const TemporaryFolder folder;
  check_problems(
      folder, tests::replaced(tests::kSmallScene, "latitude_deg = 52.009", "latitude_deg = 52.03"),
      {"@/scene.toml:11:1: E-RANGE runway end = 0 m east, 3338 m north of the origin: expected a "
       "place on the scene's "
       "terrain"});
  check_problems(
      "latitude_deg = 52.009", "latitude_deg = 52.0001",
      "11:1: E-RANGE runway length = 11.126840145255784 m: expected ends at least 100 m apart");
  check_problems("name = \"18\"", "name = \"36\"",
                 "11:1: E-REF runway[0] = name \"36\" given twice: expected a name of its own for "
                 "every runway end");
  check_problems(
      "runway = \"36\"\nstart", "runway = \"35\"\nstart",
      "26:1: E-REF trajectory.ils.runway = \"35\": expected one of the runway ends \"36\", "
      "\"18\"");
  check_problems("at = { runway = \"36\"", "at = { runway = \"09\"",
                 "17:8: E-REF box[0].at.runway = \"09\": expected one of the runway ends \"36\", "
                 "\"18\"");
}

TEST_CASE("Displaced thresholds leave 100 m of a runway to land on", "[bad_scene]") {
  const TemporaryFolder folder;
  const auto displaced = [](const std::string& first_m, const std::string& second_m) {
    return tests::replaced(tests::replaced(tests::kSmallScene, "elevation_m = 50.0 }",
                                           "elevation_m = 50.0, displaced_m = " + first_m + " }"),
                           "elevation_m = 60.0 }",
                           "elevation_m = 60.0, displaced_m = " + second_m + " }");
  };
  const auto check_told = [&](const std::string& text, const std::string& value, int line) {
    const tests::Outcome outcome = tests::build_text(folder, text);
    CHECK(outcome.scene == nullptr);
    REQUIRE(outcome.problems.size() == 1);
    const core::Problem& problem = outcome.problems[0];
    CHECK(problem.code == "E-RANGE");
    CHECK(problem.field == "displaced thresholds");
    CHECK(problem.value == value);
    CHECK(problem.expected == "at least 100 m of the pavement's 1001 m left to land on");
    CHECK(problem.place.line == line);
  };
  check_told(displaced("1500.0", "0.0"), "1500 m together", 12);
  check_told(displaced("400.0", "550.0"), "950 m together", 13);
  CHECK(tests::good_scene(folder, displaced("400.0", "450.0")) != nullptr);
}

TEST_CASE("Objects outside the terrain and unknown materials", "[bad_scene]") {
  check_problems("left_m = 200.0", "left_m = 2600.0",
                 "17:1: E-RANGE box[0].at = -2600 m east, 300 m north of the origin: expected a "
                 "place on the scene's terrain");
  check_problems("left_m = 200.0", "left_m = 2495.0",
                 "15:1: E-RANGE box = \"hangar\" reaches beyond the terrain: expected corners on "
                 "the scene's terrain");
  check_problems("height_m = 12.0", "height_m = 12.0\nwall = \"steel\"",
                 "21:1: E-REF box[0].wall = \"steel\": expected a material of the library; "
                 "nearest are metal, gravel, wall");
  check_problems("material = \"short_grass\"", "material = \"shortgrass\"",
                 "9:1: E-REF terrain.material = \"shortgrass\": expected a material of the "
                 "library; nearest are short_grass, "
                 "tall_grass, short_grass_wet");
}

TEST_CASE("A material that the scene never wrote is told to be the default", "[bad_scene]") {
  const TemporaryFolder folder;
  folder.write("library.toml",
               "[short_grass]\nmodel = \"oh1992\"\nmedium = \"concrete\"\nrms_height_mm = 0.2\n"
               "confidence = \"assumed\"\nsource = \"a test\"\n");
  const tests::Outcome outcome = tests::build_text(
      folder, "material_library = \"library.toml\"\n" +
                  tests::replaced(tests::kSmallScene, "elevation_m = 60.0 }",
                                  "elevation_m = 60.0 }\nmarking = \"chalk\"\nmarkings = false"));
  std::vector<std::string> fields;
  for (const core::Problem& problem : outcome.problems)
    if (problem.code == "E-REF" && problem.field.starts_with("runway[0]."))
      fields.push_back(problem.field);
  CHECK(fields == std::vector<std::string>{"runway[0].surface, the default",
                                           "runway[0].shoulder, the default", "runway[0].marking"});
}

TEST_CASE("A trajectory outside the terrain, and a sensor inside the ground", "[bad_scene]") {
  const TemporaryFolder folder;
  const tests::Outcome outside =
      tests::build_text(folder, tests::replaced(tests::kSmallScene, "start_distance_m = 1500.0",
                                                "start_distance_m = 3000.0"));
  REQUIRE(outside.problems.size() == 1);
  CHECK_THAT(messages(folder, outside.problems).at(0),
             Catch::StartsWith("@/scene.toml:25:2: E-RANGE trajectory = frame 0 at 0.03125 s: 0 m "
                               "east, -2998 m north of the origin: expected positions over the "
                               "scene's terrain (this is the first frame outside it of ") &&
                 Catch::Contains("; usable is "));
  const std::string header =
      "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  folder.write("flight.csv",
               header + "0,52,10,200,0,0,0\n1,52.001,10,40,0,0,0\n2,52.002,10,200,0,0,0\n");
  const tests::Outcome inside =
      tests::build_text(folder, file_trajectory("vertical_datum = \"scene\"\n"));
  REQUIRE(inside.problems.size() == 1);
  CHECK(inside.problems[0].code == "E-RANGE");
  CHECK(inside.problems[0].place.line == 25);
  CHECK(inside.problems[0].value.find("m inside the ground") != std::string::npos);
  CHECK(inside.problems[0].expected.find("vertical_datum") != std::string::npos);
}

TEST_CASE("T13 what must be above the ground is the antenna, not the aircraft", "[bad_scene]") {
  const auto outcome = [](const std::string& above_m, const std::string& down_m) {
    const TemporaryFolder folder;
    return tests::build_text(
        folder,
        tests::replaced(tests::standing(), "above_ground_m = 60.0", "above_ground_m = " + above_m) +
            "[sensor]\nfile = \"hivision.toml\"\ndown_m = " + down_m + "\n");
  };
  CHECK(outcome("0.0", "-0.5").scene != nullptr);  // wheels on the ground, the antenna on the nose
  CHECK(outcome("-0.2", "-0.5").scene != nullptr);
  for (const auto& [above_m, down_m] :
       {std::pair<const char*, const char*>{"0.5", "1.0"}, {"1.0", "1.25"}}) {
    INFO(above_m << " m up, the antenna " << down_m << " m below");
    const std::vector<core::Problem> found = outcome(above_m, down_m).problems;
    REQUIRE(found.size() == 1);
    CHECK(found[0].code == "E-RANGE");
    CHECK(found[0].field == "trajectory");
    CHECK(found[0].value.find("m inside the ground") != std::string::npos);
    CHECK(found[0].expected.find("mounting") != std::string::npos);
  }
}

// 118.6 m on 1001 m, 11.85 %, as at Lukla.
TEST_CASE("An approach onto a steep runway is no error uphill", "[bad_scene]") {
  const TemporaryFolder folder;
  grid_around().write(folder, "dem", [](int, int row) {
    const double north_m = (52.04 - 0.002 * (row + 0.5) - 52.0) / 0.009 * 1001.0;
    return std::to_string(50.0 + std::clamp(0.1185 * north_m, 0.0, 118.6));
  });
  const std::string text = tests::replaced(
      tests::replaced(tests::kSmallScene, "elevation_m = 60.0", "elevation_m = 168.6"),
      "material = \"short_grass\"", "elevation = \"dem.asc\"");
  const tests::Outcome uphill = tests::build_text(folder, text);
  CHECK(uphill.scene != nullptr);
  CHECK(uphill.problems.empty());
  const tests::Outcome downhill = tests::build_text(
      folder, tests::replaced(text, "runway = \"36\"\nstart", "runway = \"18\"\nstart"));
  REQUIRE(downhill.problems.size() == 1);
  CHECK(downhill.problems[0].expected == "a runway less steep than the glide path");
}

TEST_CASE("A flight into the ground is told with the time that can be used, which then builds",
          "[bad_scene]") {
  // 10 m/s down from 200 m, over ground at 50 to 60 m from 14 s on.
  std::string rows = "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  for (int t = 0; t <= 20; ++t)
    rows += std::to_string(t) + "," + core::number_text(51.99 + 0.0005 * t) + ",10," +
            std::to_string(200 - 10 * t) + ",0,0,0\n";
  const TemporaryFolder folder;
  folder.write("flight.csv", rows);
  const tests::Outcome inside =
      tests::build_text(folder, file_trajectory("vertical_datum = \"scene\"\n"));
  REQUIRE(inside.problems.size() == 1);
  const core::Problem& problem = inside.problems[0];
  INFO(core::to_string(problem));
  CHECK(problem.value.find("m inside the ground") != std::string::npos);
  CHECK(problem.value.find(" 0 m inside") == std::string::npos);
  std::smatch window;
  REQUIRE(std::regex_search(
      problem.expected, window,
      std::regex("usable is from_time_s = ([0-9.]+) to to_time_s = ([0-9.]+) \\(([0-9]+) frames")));
  CHECK(window[1] == "0.032");
  CHECK(std::stod(window[2]) > 13.5);
  CHECK(std::stod(window[2]) < 15.0);
  const std::unique_ptr<scenes::Scene> scene = tests::good_scene(
      folder, file_trajectory("vertical_datum = \"scene\"\nfrom_time_s = " + window.str(1) +
                              "\nto_time_s = " + window.str(2) + "\n"));
  CHECK(scene->frame_count() == 13 * 16);  // rows from 1 s to 14 s
}

TEST_CASE("A flight shorter than a frame is refused", "[bad_scene]") {
  const TemporaryFolder folder;
  folder.write("flight.csv",
               "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n"
               "0,52,10,200,0,0,0\n0.05,52.00002,10,200,0,0,0\n");
  check_problems(
      folder, file_trajectory("vertical_datum = \"scene\"\n"),
      {"@/scene.toml:25:2: E-RANGE trajectory = 0.05 s long: expected at least one frame "
       "of 0.0625 s"});
}

TEST_CASE("A wrong row stops a scene, or is left out and recorded, or is flown", "[bad_scene]") {
  std::string rows = "time_s,latitude_deg,longitude_deg,alt_ft,roll_deg,pitch_deg,heading_deg\n";
  for (int t = 0; t <= 20; ++t)
    rows += std::to_string(t) + "," + core::number_text(51.99 + 0.0005 * t) + ",10," +
            (t == 7 ? "35925" : "1000") + ",0,0,0\n";
  const TemporaryFolder folder;
  folder.write("flight.csv", rows);
  const std::string keys = "vertical_datum = \"scene\"\ncolumns = { height = \"alt_ft\" }\n";
  const tests::Outcome refused = tests::build_text(folder, file_trajectory(keys));
  CHECK(refused.scene == nullptr);
  REQUIRE(refused.problems.size() == 1);
  CHECK(refused.problems[0].place.line == 9);
  CHECK(refused.problems[0].field == "row 8, height");

  const auto highest_m = [](const scenes::Scene& scene) {
    double height_m = 0.0;
    for (const core::Pose& pose : scene.trajectory->poses())
      height_m = std::max(height_m, pose.position.height_m);
    return height_m;
  };
  const std::unique_ptr<scenes::Scene> rejected =
      tests::good_scene(folder, file_trajectory(keys + "outliers = \"reject\"\n"));
  CHECK(highest_m(*rejected) == Approx(304.8));
  REQUIRE(rejected->trajectory->rejected.size() == 1);
  CHECK(rejected->trajectory->rejected[0].first_row == 8);
  const std::unique_ptr<scenes::Scene> kept =
      tests::good_scene(folder, file_trajectory(keys + "outliers = \"keep\"\n"));
  CHECK(highest_m(*kept) == Approx(35925.0 * 0.3048));
  CHECK(kept->trajectory->rejected.empty());
}

TEST_CASE("Trajectory files: problems have the file's own line", "[bad_scene]") {
  const TemporaryFolder folder;
  folder.write(
      "flight.csv",
      "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n0,52.001,10,nan\n1,x,10,200\n");
  check_problems(
      folder, file_trajectory("vertical_datum = \"scene\"\n"),
      {"@/flight.csv:3: E-TIME time_s = 0 s: expected later than 0 s in line 2",
       "@/flight.csv:3: E-NONFINITE height_m = \"nan\": expected a finite number",
       "@/flight.csv:4: E-PARSE latitude_deg = \"x\": expected a number with a decimal point"});
  check_problems(
      folder, file_trajectory("vertical_datum = \"scene\"\ncolumns = { height = \"alt_ft\" }\n"),
      {"@/flight.csv:1: E-PARSE column \"alt_ft\" = missing: expected a column of this name; there "
       "are time_s, latitude_deg, longitude_deg, height_m"});
  check_problems(
      folder, file_trajectory("vertical_datum = \"scene\"\ncolumns = { height = \"heigth_m\" }\n"),
      {"@/flight.csv:1: E-PARSE column \"heigth_m\" = missing: expected a column of this name; "
       "perhaps height_m of time_s, latitude_deg, longitude_deg, height_m"});
}

TEST_CASE("A column that a scene names must be there, a default one may be missing",
          "[bad_scene]") {
  const TemporaryFolder folder;
  std::string rows = "time_s,latitude_deg,longitude_deg,height_m,bank_deg\n";
  for (int t = 0; t <= 20; ++t)
    rows += std::to_string(t) + "," + core::number_text(51.99 + 0.0005 * t) + ",10,300,0\n";
  folder.write("flight.csv", rows);
  const auto flight = [](const std::string& columns) {
    return file_trajectory("vertical_datum = \"scene\"\ncolumns = { " + columns + " }\n");
  };
  check_problems(folder, flight("roll = \"bnak_deg\""),
                 {"@/flight.csv:1: E-PARSE column \"bnak_deg\" = missing: expected a column of "
                  "this name; perhaps bank_deg of time_s, latitude_deg, longitude_deg, height_m, "
                  "bank_deg"});
  CHECK(tests::good_scene(folder, flight("roll = \"bank_deg\"")) != nullptr);
  CHECK(tests::good_scene(folder, flight("height = \"height_m\"")) != nullptr);
}

TEST_CASE("R17 absurd sizes are E-LIMIT or E-RANGE at once, without allocating", "[bad_scene]") {
  const double begin_s = tests::processor_time_s();
  check_problems("half_extent_m = 2500.0\nspacing_m = 50.0",
                 "half_extent_m = 200000.0\nspacing_m = 0.5",
                 "6:1: E-LIMIT terrain = terrain posts: 640001600001: expected at most 64 million "
                 "posts: a larger spacing_m or a "
                 "smaller extent");
  check_problems("spacing_m = 50.0", "spacing_m = 0",
                 "8:1: E-RANGE terrain.spacing_m = 0: expected 0.5 to 1000");
  check_problems("half_extent_m = 2500.0", "half_extent_m = 1e12",
                 "7:1: E-RANGE terrain.half_extent_m = 1e+12: expected 10 to 200000");
  check_problems(
      "[weather]",
      "[[line]]\nfrom = { runway = \"36\", behind_threshold_m = 0.0 }\nto = { runway = \"36\", "
      "behind_threshold_m = "
      "1999.0 }\nspacing_m = 0.01\n[weather]",
      "22:1: E-LIMIT line = \"line\" of 199901 points: expected at most 100000: a wider spacing_m");
  check_problems("[weather]", "[accuracy]\nrays_per_cell = 1e12\n[weather]",
                 "23:1: E-RANGE accuracy.rays_per_cell = 1e+12: expected 0, or 0.3 to 10000");
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
}

TEST_CASE("Errors that show only when the scene is built come together too", "[bad_scene]") {
  const TemporaryFolder folder;
  std::string text = tests::replaced(tests::kSmallScene, "left_m = 200.0", "left_m = 2600.0");
  text = tests::replaced(text, "material = \"short_grass\"", "material = \"grass\"");
  text = tests::replaced(
      text, "[weather]",
      "[[target]]\nat = { runway = \"27\", behind_threshold_m = 0.0 }\nrcs = { shape = "
      "\"constant\" }\n"
      "[[surface]]\nrunway = \"36\"\nmaterial = \"tarmac\"\nbehind_threshold_m = [0.0, 100.0]\n"
      "left_m = [50.0, 80.0]\n[weather]");
  const tests::Outcome outcome = tests::build_text(folder, text);
  std::vector<std::string> places;
  for (const core::Problem& problem : outcome.problems)
    places.push_back(std::to_string(problem.place.line) + " " + problem.code);
  CHECK(places == std::vector<std::string>{"9 E-REF", "17 E-RANGE", "23 E-REF", "27 E-REF"});
}

// They came one after the other, in as many runs.
TEST_CASE("A box and a target off the terrain hide neither a material nor a flight that is wrong",
          "[bad_scene]") {
  const TemporaryFolder folder;
  std::string text = tests::kSmallScene;
  text.erase(text.find("[trajectory.ils]"));
  text +=
      "[[box]]\nat = { latitude_deg = 52.0009, longitude_deg = 10.131 }\nlength_m = 1.0\n"
      "width_m = 1.0\nheight_m = 1.0\nwall = \"metall\"\n"
      "[[target]]\nat = { latitude_deg = 52.0, longitude_deg = 10.131 }\nrcs = \"person\"\n"
      "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
      "above_ground_m = -5.0\n";
  const tests::Outcome outcome = tests::build_text(folder, text);
  const auto told = [&](const std::string& field, const std::string& value) {
    return std::count_if(outcome.problems.begin(), outcome.problems.end(),
                         [&](const core::Problem& one) {
                           return one.field.find(field) != std::string::npos &&
                                  one.value.find(value) != std::string::npos;
                         });
  };
  for (const core::Problem& one : outcome.problems) UNSCOPED_INFO(core::to_string(one));
  CHECK(told("box[1].at", "east") == 1);
  CHECK(told("target[0].at", "east") == 1);
  CHECK(told("box[1].wall", "metall") == 1);
  CHECK(told("trajectory", "inside the ground") == 1);
}
