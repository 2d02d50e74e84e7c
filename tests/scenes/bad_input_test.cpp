// Whatever is wrong with a scene is told with file, line, column, value and what was expected, all of it at once, and
// nothing is built.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>

#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using tests::AsciiGrid;
using tests::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

void check(const TemporaryFolder& folder, const std::string& text, const std::vector<std::string>& expected) {
  const tests::Outcome outcome = tests::build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  CHECK(tests::messages(folder, outcome.problems) == expected);
}

// One replacement in the small scene, one message.
void check(const std::string& from, const std::string& to, const std::string& expected) {
  const TemporaryFolder folder;
  INFO(from << " -> " << to);
  check(folder, tests::replaced(tests::kSmallScene, from, to), {"@/scene.toml:" + expected});
}

const std::string kIls = "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0\n";

std::string file_trajectory(const std::string& keys) {
  return tests::replaced(tests::kSmallScene, kIls, "[trajectory]\nfile = \"flight.csv\"\n" + keys);
}

// Posts every 0.002 deg around the scene, all 40 m high.
AsciiGrid grid_around() { return {60, 40, 9.94, 51.96, 0.002}; }

}  // namespace

TEST_CASE("The scene that the cases below spoil is good", "[bad_input]") {
  const TemporaryFolder folder;
  const tests::Outcome outcome = tests::build_text(folder, tests::kSmallScene);
  CHECK(tests::messages(folder, outcome.problems).empty());
  CHECK(outcome.scene != nullptr);
}

TEST_CASE("Wrong keys and wrong unit suffixes name the key that was meant", "[bad_input]") {
  check("visibility_m = 400.0", "visibilty_m = 400.0",
        "23:1: E-REF weather.visibilty_m = unknown key: expected a key of this table, perhaps \"visibility_m\"");
  check("visibility_m = 400.0", "visibility_km = 0.4",
        "23:1: E-REF weather.visibility_km = unknown key: expected a key of this table, perhaps \"visibility_m\"");
  check("height_m = 12.0", "height_m = 12.0\nheading_rad = 1.0",
        "21:1: E-REF box[0].heading_rad = unknown key: expected a key of this table, perhaps \"heading_deg\"");
  check("[weather]", "[wether]", "22:2: E-REF wether = unknown key: expected a key of this table, perhaps \"weather\"");
  check("left_m = 200.0", "right_m = 200.0",
        "17:51: E-REF box[0].at.right_m = unknown key: expected a key of this table, such as \"left_m\", \"runway\", "
        "\"behind_threshold_m\"");
  check("spacing_m = 50.0", "spacing_m = 50.0\nrelief_m = 5.0",  // of the rolling generator only
        "9:1: E-REF terrain.relief_m = unknown key: expected a key of this table, such as \"east_m\", \"west_m\", "
        "\"north_m\", \"south_m\", \"spacing_m\"");
}

TEST_CASE("Wrong types and syntax errors have a line and a column", "[bad_input]") {
  check("visibility_m = 400.0", "visibility_m = \"400 m\"",
        "23:1: E-PARSE weather.visibility_m = \"400 m\": expected a number, 10 to 100000");
  check("height_m = 12.0", "height_m = 12,0",
        "20:14: E-PARSE syntax = Error while parsing key-value pair: expected a comment or whitespace, saw ',': "
        "expected TOML");
  check("[[box]]", "[box]", "15:2: E-PARSE box = a table: expected an array of tables, [[box]]");
}

TEST_CASE("T06 scene values outside their domain, each class by its name", "[bad_input]") {
  check("latitude_deg = 52.0,", "latitude_deg = 90.0000001,",
        "3:12: E-RANGE scene.origin.latitude_deg = 90.0000001: expected -90 to 90");
  check("latitude_deg = 52.009,", "latitude_deg = -91,",
        "13:25: E-RANGE runway[0].second.latitude_deg = -91: expected -90 to 90");
  check("latitude_deg = 52.0,", "latitude_deg = nan,",
        "3:12: E-NONFINITE scene.origin.latitude_deg = nan: expected -90 to 90");
  check("longitude_deg = 10.0,", "longitude_deg = inf,",
        "3:33: E-NONFINITE scene.origin.longitude_deg = inf: expected -180 to 180");
  check("longitude_deg = 10.0,", "longitude_deg = 1e300,",
        "3:33: E-RANGE scene.origin.longitude_deg = 1e+300: expected -180 to 180");
  check("height_m = 50.0", "height_m = 1e9",
        "3:55: E-RANGE scene.origin.height_m = 1e+09: expected -1000 to 9000");
  check("elevation_m = 60.0", "elevation_m = nan",
        "13:70: E-NONFINITE runway[0].second.elevation_m = nan: expected -500 to 6000");
  check("visibility_m = 400.0", "visibility_m = -3",
        "23:1: E-RANGE weather.visibility_m = -3: expected 10 to 100000");
}

TEST_CASE("Datums: a wrong name, none, and one that cannot be brought to the scene's", "[bad_input]") {
  check("\"scene\"", "\"egm2008\"",
        "4:1: E-RANGE scene.vertical_datum = \"egm2008\": expected one of \"ellipsoid\", \"egm96\", \"scene\"");
  check("vertical_datum = \"scene\"\n", "",
        "1:1: E-REF scene.vertical_datum = missing: expected what heights count from: \"ellipsoid\", \"egm96\" or \"scene\"");
  const TemporaryFolder folder;
  folder.write("flight.csv", "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n");
  check(folder, file_trajectory(""),
        {"@/scene.toml:25:1: E-REF trajectory.vertical_datum = missing: expected what the file's heights count from: "
         "\"ellipsoid\", \"egm96\" or \"scene\""});
  check(folder, file_trajectory("vertical_datum = \"egm96\"\n"),
        {"@/scene.toml:27:1: E-RANGE trajectory.vertical_datum = a datum of its own: expected \"scene\": the scene's "
         "heights count from an unknown level"});
}

TEST_CASE("Missing files are named with every place that was searched", "[bad_input]") {
  check("material = \"short_grass\"", "elevation = \"dem.tif\"",
        "9:1: E-IO terrain.elevation = \"dem.tif\" not found: expected a file in one of: @; name another data folder "
        "with --data DIR or FANBEAM_DATA");
  check("[weather]", "[sensor]\nfile = \"radar.toml\"\n[weather]",
        "23:1: E-IO sensor.file = \"radar.toml\" not found: expected a sensor file in the scene's folder or #/sensors");
  const TemporaryFolder folder;
  folder.write("scene.toml", tests::replaced(tests::kSmallScene, "[[box]]",
                                             "[[buildings]]\nfile = \"city/houses.geojson\"\n[[box]]"));
  const tests::Outcome outcome = tests::build(folder.path(), {folder.path() / "data", "/nowhere"});
  CHECK(tests::messages(folder, outcome.problems) ==
        std::vector<std::string>{
            "@/scene.toml:16:1: E-IO buildings[0].file = \"city/houses.geojson\" not found: expected a file in one of: "
            "@, @/data, /nowhere; name another data folder with --data DIR or FANBEAM_DATA"});
}

TEST_CASE("F05 files outside the scene's folder are never opened", "[bad_input]") {
  for (const auto& [name, reason] : std::vector<std::pair<std::string, std::string>>{
           {"../flight.csv", "it leaves the folder"},
           {"/etc/hostname", "it is absolute"},
           {"link", "it leaves the folder"},
           {"http://host/a.csv", "it names a URI scheme"},
           {"file:///etc/hostname", "it names a URI scheme"},
           {"", "it is empty"}}) {
    const TemporaryFolder folder;
    fs::create_symlink("/etc/hostname", folder.path() / "link");
    const std::string text = tests::replaced(tests::kSmallScene, kIls,
                                             "[trajectory]\nfile = \"" + name + "\"\nvertical_datum = \"scene\"\n");
    INFO(name);
    check(folder, text,
          {"@/scene.toml:26:1: E-PATH trajectory.file = \"" + name + "\": expected a path inside @ (" + reason + ")"});
  }
}

TEST_CASE("A raster without georeference, a damaged one, one with voids, one that ends too early", "[bad_input]") {
  const std::string text =
      tests::replaced(tests::kSmallScene, "material = \"short_grass\"", "elevation = \"dem.asc\"");
  const auto flat = [](int, int) { return "40"; };
  {
    const TemporaryFolder folder;
    AsciiGrid grid = grid_around();
    grid.wkt = "";
    grid.write(folder, "dem", flat);
    check(folder, text,
          {"@/scene.toml:9:1: E-REF terrain.elevation = dem.asc, georeference: no coordinate reference system: expected "
           "a geotransform and a coordinate reference system"});
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
    grid_around().write(folder, "dem", [](int column, int) { return column == 3 ? "-9999" : "40"; });
    const tests::Outcome outcome = tests::build_text(folder, text);
    REQUIRE(outcome.problems.size() == 1);
    CHECK(outcome.problems[0].code == "E-RANGE");
    CHECK(outcome.problems[0].place.line == 9);
    const tests::Outcome filled =
        tests::build_text(folder, tests::replaced(text, "elevation = \"dem.asc\"", "elevation = \"dem.asc\"\nvoids = \"fill\""));
    CHECK(filled.scene != nullptr);
    REQUIRE(filled.problems.size() == 1);
    CHECK(filled.problems[0].code == "W-VOID");
  }
  {
    const TemporaryFolder folder;
    AsciiGrid grid = grid_around();
    grid.south = 51.99;  // the terrain begins 2.5 km south of the origin
    grid.write(folder, "dem", flat);
    const tests::Outcome outcome = tests::build_text(folder, text);
    REQUIRE(outcome.problems.size() == 1);
    CHECK(outcome.problems[0].field == "terrain extent");
    CHECK(outcome.problems[0].value.find("posts without elevation, the first at 51.9775") != std::string::npos);
    CHECK(outcome.problems[0].place.line == 6);
  }
}

TEST_CASE("Land cover: classes without material, materials that do not exist, no class at all", "[bad_input]") {
  const TemporaryFolder folder;
  grid_around().write(folder, "cover", [](int column, int) { return column < 30 ? "1" : "7"; });
  const auto with_classes = [](const std::string& classes) {
    return tests::replaced(tests::kSmallScene, "material = \"short_grass\"",
                           "land_cover = { file = \"cover.asc\", classes = { " + classes + " } }");
  };
  check(folder, with_classes("1 = \"forest\""),
        {"@/scene.toml:6:1: E-REF terrain.land_cover.classes = class 7 of the raster has no material: expected 7 = "
         "\"...\""});
  check(folder, with_classes("1 = \"forest\", 7 = \"gras\""),
        {"@/scene.toml:6:1: E-REF terrain.land_cover.classes.7 = \"gras\": expected a material of the library; nearest "
         "are crops, gravel, urban"});
  check(folder, with_classes("1 = \"forest\", seven = \"crops\""),
        {"@/scene.toml:9:62: E-PARSE terrain.land_cover.classes.seven = \"seven\": expected a class number as the key"});
  check(folder, with_classes("1 = \"forest\", 65536 = \"crops\""),
        {"@/scene.toml:9:62: E-RANGE terrain.land_cover.classes.65536 = 65536: expected a class from 0 to 65535"});
}

TEST_CASE("Runways off the map, too short, named twice, and ends that do not exist", "[bad_input]") {
  const TemporaryFolder folder;
  check(folder, tests::replaced(tests::kSmallScene, "latitude_deg = 52.009", "latitude_deg = 52.03"),
        {"@/scene.toml:11:1: E-RANGE runway end = 0 m east, 3338 m north of the origin: expected a place on the scene's "
         "terrain"});
  check("latitude_deg = 52.009", "latitude_deg = 52.0001",
        "11:1: E-RANGE runway length = 11.126840145255784 m: expected ends at least 100 m apart");
  check("name = \"18\"", "name = \"36\"",
        "11:1: E-REF runway[0] = name \"36\" given twice: expected a name of its own for every runway end");
  check("runway = \"36\"\nstart", "runway = \"35\"\nstart",
        "25:2: E-REF runway = \"35\": expected one of the runway ends \"36\", \"18\"");
  check("at = { runway = \"36\"", "at = { runway = \"09\"",
        "17:1: E-REF runway = \"09\": expected one of the runway ends \"36\", \"18\"");
}

TEST_CASE("Objects outside the terrain and unknown materials", "[bad_input]") {
  check("left_m = 200.0", "left_m = 2600.0",
        "17:1: E-RANGE box[0].at = -2600 m east, 300 m north of the origin: expected a place on the scene's terrain");
  check("left_m = 200.0", "left_m = 2495.0",
        "15:1: E-RANGE box = \"hangar\" reaches beyond the terrain: expected corners on the scene's terrain");
  check("height_m = 12.0", "height_m = 12.0\nwall = \"steel\"",
        "15:1: E-REF box material = \"steel\": expected a material of the library; nearest are gravel, metal, wall");
  check("material = \"short_grass\"", "material = \"shortgrass\"",
        "6:1: E-REF terrain.material = \"shortgrass\": expected a material of the library; nearest are short_grass, "
        "tall_grass, forest");
}

TEST_CASE("A trajectory outside the terrain, and a sensor inside the ground", "[bad_input]") {
  const TemporaryFolder folder;
  check("start_distance_m = 1500.0", "start_distance_m = 3000.0", 
        "25:2: E-RANGE trajectory = frame 0 at 0.03125 s: 0 m east, -2998 m north of the origin: expected positions over "
        "the scene's terrain (this is the first frame outside it)");
  const std::string header = "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  folder.write("flight.csv", header + "0,52,10,200,0,0,0\n1,52.001,10,40,0,0,0\n2,52.002,10,200,0,0,0\n");
  const tests::Outcome inside = tests::build_text(folder, file_trajectory("vertical_datum = \"scene\"\n"));
  REQUIRE(inside.problems.size() == 1);
  CHECK(inside.problems[0].code == "E-RANGE");
  CHECK(inside.problems[0].place.line == 25);
  CHECK(inside.problems[0].value.find("m inside the ground") != std::string::npos);
  CHECK(inside.problems[0].expected.find("vertical_datum") != std::string::npos);
}

TEST_CASE("Trajectory files: problems have the file's own line", "[bad_input]") {
  const TemporaryFolder folder;
  folder.write("flight.csv", "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n0,52.001,10,nan\n1,x,10,200\n");
  check(folder, file_trajectory("vertical_datum = \"scene\"\n"),
        {"@/flight.csv:3: E-TIME time_s = 0 s: expected later than 0 s in line 2",
         "@/flight.csv:3: E-NONFINITE height_m = \"nan\": expected a finite number",
         "@/flight.csv:4: E-PARSE latitude_deg = \"x\": expected a number with a decimal point"});
  check(folder, file_trajectory("vertical_datum = \"scene\"\ncolumns = { height = \"alt_ft\" }\n"),
        {"@/flight.csv:1: E-PARSE column \"alt_ft\" = missing: expected a column of this name"});
}

TEST_CASE("Exactly one kind of trajectory", "[bad_input]") {
  check(kIls, "",
        "1:1: E-REF trajectory = missing: expected exactly one of: file = \"....csv\", [trajectory.ils], "
        "[trajectory.fixed]");
  check("[trajectory.ils]", "[trajectory.fixed]\nabove_ground_m = 3\n[trajectory.ils]",
        "25:2: E-REF trajectory = more than one kind: expected exactly one of: file = \"....csv\", [trajectory.ils], "
        "[trajectory.fixed]");
}

TEST_CASE("R17 absurd sizes are E-LIMIT or E-RANGE at once, without allocating", "[bad_input]") {
  const auto begin = std::chrono::steady_clock::now();
  check("half_extent_m = 2500.0\nspacing_m = 50.0", "half_extent_m = 200000.0\nspacing_m = 0.5",
        "6:1: E-LIMIT terrain = terrain posts: 640001600001: expected at most 64 million posts: a larger spacing_m or a "
        "smaller extent");
  check("spacing_m = 50.0", "spacing_m = 0", "8:1: E-RANGE terrain.spacing_m = 0: expected 0.5 to 1000");
  check("half_extent_m = 2500.0", "half_extent_m = 1e12",
        "7:1: E-RANGE terrain.half_extent_m = 1e+12: expected 10 to 200000");
  check("[weather]",
        "[[line]]\nfrom = { runway = \"36\", behind_threshold_m = 0.0 }\nto = { runway = \"36\", behind_threshold_m = "
        "1999.0 }\nspacing_m = 0.01\n[weather]",
        "22:1: E-LIMIT line = \"line\" of 199901 points: expected at most 100000: a wider spacing_m");
  check("[weather]", "[accuracy]\nrays_per_cell = 1e12\n[weather]",
        "23:1: E-RANGE accuracy.rays_per_cell = 1e+12: expected 0 to 10000");
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < 5.0);
}

TEST_CASE("Everything wrong in a scene and its sensor is told in one run", "[bad_input]") {
  const TemporaryFolder folder;
  folder.write("radar.toml", "name = \"half a radar\"\n[scan]\ncolumns = 0\n");
  std::string text = tests::kSmallScene;
  text = tests::replaced(text, "\"scene\"", "\"mean\"");
  text = tests::replaced(text, "half_extent_m = 2500.0", "elevation = \"dem.tif\"");
  text = tests::replaced(text, "elevation_m = 60.0", "elevation_ft = 200.0");
  text = tests::replaced(text, "height_m = 12.0", "height_m = -1.0");
  text = tests::replaced(text, "[weather]\nvisibility_m = 400.0", "[sensor]\nfile = \"radar.toml\"\n[weather]\nvisibility = 3");
  const tests::Outcome outcome = tests::build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  std::vector<std::string> fields;
  for (const core::Problem& problem : outcome.problems) {
    fields.push_back(problem.field);
    CHECK(problem.place.line > 0);
    CHECK_FALSE(problem.expected.empty());
  }
  for (const char* field : {"scene.vertical_datum", "terrain.elevation", "runway[0].second.elevation_m",
                            "runway[0].second.elevation_ft", "box[0].height_m", "weather.visibility", "scan.columns",
                            "waveform.frequency_GHz"})
    CHECK(std::count(fields.begin(), fields.end(), field) == 1);
}

TEST_CASE("Errors that show only when the scene is built come together too", "[bad_input]") {
  const TemporaryFolder folder;
  std::string text = tests::replaced(tests::kSmallScene, "left_m = 200.0", "left_m = 2600.0");
  text = tests::replaced(text, "material = \"short_grass\"", "material = \"grass\"");
  text = tests::replaced(text, "[weather]",
                         "[[target]]\nat = { runway = \"27\", behind_threshold_m = 0.0 }\nrcs = { shape = \"constant\" }\n"
                         "[[surface]]\nrunway = \"36\"\nmaterial = \"tarmac\"\nbehind_threshold_m = [0.0, 100.0]\n"
                         "left_m = [50.0, 80.0]\n[weather]");
  const tests::Outcome outcome = tests::build_text(folder, text);
  std::vector<std::string> places;
  for (const core::Problem& problem : outcome.problems)
    places.push_back(std::to_string(problem.place.line) + " " + problem.code);
  CHECK(places == std::vector<std::string>{"6 E-REF", "25 E-REF", "17 E-RANGE", "23 E-REF"});
}
