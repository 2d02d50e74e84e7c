// Whatever is wrong with the text of a scene, or with the files that it names, is told with file,
// line, column, value and what was expected, all of it at once, and nothing is built.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "core/files.h"
#include "scenes/scene_reader.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::check_problems;
using tests::file_trajectory;
using tests::kIls;
using tests::kSmallScene;
using tests::TemporaryFolder;

namespace fs = std::filesystem;

TEST_CASE("The scene that the cases below spoil is good", "[bad_input]") {
  const TemporaryFolder folder;
  const tests::Outcome outcome = tests::build_text(folder, tests::kSmallScene);
  CHECK(tests::messages(folder, outcome.problems).empty());
  CHECK(outcome.scene != nullptr);
}

TEST_CASE("Wrong keys and wrong unit suffixes name the key that was meant", "[bad_input]") {
  check_problems("visibility_m = 400.0", "visibilty_m = 400.0",
                 "23:1: E-REF weather.visibilty_m = unknown key: expected a key of this table, "
                 "perhaps \"visibility_m\"");
  check_problems("visibility_m = 400.0", "visibility_km = 0.4",
                 "23:1: E-REF weather.visibility_km = unknown key: expected a key of this table, "
                 "perhaps \"visibility_m\"");
  check_problems("height_m = 12.0", "height_m = 12.0\nheading_rad = 1.0",
                 "21:1: E-REF box[0].heading_rad = unknown key: expected a key of this table, "
                 "perhaps \"heading_deg\"");
  check_problems(
      "[weather]", "[wether]",
      "22:2: E-REF wether = unknown key: expected a key of this table, perhaps \"weather\"");
  check_problems("left_m = 200.0", "right_m = 200.0",
                 "17:51: E-REF box[0].at.right_m = unknown key: expected a key of this table, such "
                 "as \"left_m\"");
  check_problems(
      "spacing_m = 50.0", "spacing_m = 50.0\nrelieve_m = 5.0",
      "9:1: E-REF terrain.relieve_m = unknown key: expected a key of this table, perhaps "
      "\"relief_m\"");
}

TEST_CASE("A key that needs another one is told with that, not as unknown", "[bad_input]") {
  check_problems("spacing_m = 50.0", "spacing_m = 50.0\nrelief_m = 5.0",
                 "9:1: E-REF terrain.relief_m = 5: expected no such key without generator = "
                 "\"rolling\"");
  check_problems("spacing_m = 50.0", "spacing_m = 50.0\nvoids = \"fill\"",
                 "9:1: E-REF terrain.voids = \"fill\": expected no such key without elevation");
  const std::string line =
      "[[line]]\nfrom = { runway = \"36\", behind_threshold_m = 0.0 }\n"
      "to = { runway = \"36\", behind_threshold_m = 50.0 }\n";
  check_problems("[[box]]", line + "radius_m = 0.01\n[[box]]",
                 "18:1: E-REF line[0].radius_m = 0.01: expected no such key without model = "
                 "\"wire\"");
  check_problems("[[box]]", line + "model = \"wire\"\nrcs_dBsm_per_m = -10.0\n[[box]]",
                 "19:1: E-REF line[0].rcs_dBsm_per_m = -10: expected no such key without model = "
                 "\"even\"");
}

TEST_CASE("Wrong types and syntax errors have a line and a column", "[bad_input]") {
  check_problems("visibility_m = 400.0", "visibility_m = \"400 m\"",
                 "23:1: E-PARSE weather.visibility_m = \"400 m\": expected a number, 10 to 100000");
  check_problems("height_m = 12.0", "height_m = 12,0",
                 "20:14: E-PARSE syntax = Error while parsing key-value pair: expected a comment "
                 "or whitespace, saw ',': "
                 "expected TOML");
  check_problems("[[box]]", "[box]",
                 "15:2: E-PARSE box = a table: expected an array of tables, [[box]]");
}

TEST_CASE("T06 scene values outside their domain, each class by its name", "[bad_input]") {
  check_problems("latitude_deg = 52.0,", "latitude_deg = 90.0000001,",
                 "3:12: E-RANGE scene.origin.latitude_deg = 90.0000001: expected -90 to 90");
  check_problems("latitude_deg = 52.009,", "latitude_deg = -91,",
                 "13:25: E-RANGE runway[0].second.latitude_deg = -91: expected -90 to 90");
  check_problems("latitude_deg = 52.0,", "latitude_deg = nan,",
                 "3:12: E-NONFINITE scene.origin.latitude_deg = nan: expected -90 to 90");
  check_problems("longitude_deg = 10.0,", "longitude_deg = inf,",
                 "3:33: E-NONFINITE scene.origin.longitude_deg = inf: expected -180 to 180");
  check_problems("longitude_deg = 10.0,", "longitude_deg = 1e300,",
                 "3:33: E-RANGE scene.origin.longitude_deg = 1e+300: expected -180 to 180");
  check_problems("height_m = 50.0", "height_m = 1e9",
                 "3:55: E-RANGE scene.origin.height_m = 1e+09: expected -1000 to 9000");
  check_problems("elevation_m = 60.0", "elevation_m = nan",
                 "13:70: E-NONFINITE runway[0].second.elevation_m = nan: expected -500 to 6000");
  check_problems("visibility_m = 400.0", "visibility_m = -3",
                 "23:1: E-RANGE weather.visibility_m = -3: expected 10 to 100000");
}

TEST_CASE("A02 impossible rain is refused by class with the range that is allowed", "[bad_input]") {
  for (const auto& [rate, found] : std::vector<std::pair<std::string, std::string>>{
           {"-1", "E-RANGE weather.rain_rate_mm_per_h = -1"},
           {"1e6", "E-RANGE weather.rain_rate_mm_per_h = 1000000"},
           {"nan", "E-NONFINITE weather.rain_rate_mm_per_h = nan"},
           {"inf", "E-NONFINITE weather.rain_rate_mm_per_h = inf"}})
    check_problems("visibility_m = 400.0", "rain_rate_mm_per_h = " + rate,
                   "23:1: " + found + ": expected 0 to 300");
}

TEST_CASE("A display's window belongs to its mapping, in a scene as in a sensor file",
          "[bad_input]") {
  const TemporaryFolder folder;
  const std::string place = "@/scene.toml:28:1: ";
  check_problems(folder, kSmallScene + "[display]\nmapping = \"log\"\n",
                 {place + "E-REF display.low_dB = missing: expected -400 to 400",
                  place + "E-REF display.high_dB = missing: expected -400 to 400"});
  check_problems(folder, kSmallScene + "[display]\nmapping = \"log\"\nlow_dB = -150.0\n",
                 {place + "E-REF display.high_dB = missing: expected -400 to 400"});
  check_problems(folder, kSmallScene + "[display]\nlow_dB = 9.0\n",
                 {place + "E-RANGE display.high_dB = 5: expected above low_dB = 9"});
  CHECK(tests::build_text(folder, kSmallScene + "[display]\nmapping = \"seed\"\n").scene);

  // A sensor that looks from its own place on has no strongest signal.
  const std::string hivision =
      core::read_file(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", 1U << 20U);
  folder.write("near.toml", tests::replaced(hivision, "minimum_m = 200.0", "minimum_m = 0.0"));
  const std::string near = kSmallScene + "[sensor]\nfile = \"near.toml\"\n";
  CHECK(tests::build_text(folder, near).scene);
  check_problems(folder, near + "[display]\nmapping = \"seed\"\n",
                 {"@/scene.toml:31:1: E-RANGE display.mapping = \"seed\": expected range.minimum_m "
                  "of the sensor above 0, which its strongest signal needs"});
  // A sensor that shows received power has no NRCS window to lend.
  folder.write("power.toml",
               tests::replaced(tests::replaced(tests::replaced(hivision, "mapping = \"stc\"",
                                                               "mapping = \"log\""),
                                               "low_dB = -55.0", "low_dB = -150.0"),
                               "high_dB = 5.0", "high_dB = -90.0"));
  const std::string power = kSmallScene + "[sensor]\nfile = \"power.toml\"\n[display]\n";
  CHECK(tests::build_text(folder, power + "low_dB = -140.0\n").scene);
  check_problems(folder, power + "mapping = \"stc\"\nlow_dB = -50.0\n",
                 {"@/scene.toml:30:1: E-REF display.high_dB = missing: expected -400 to 400"});
}

TEST_CASE("Datums: a wrong name, none, and one that cannot be brought to the scene's",
          "[bad_input]") {
  check_problems("\"scene\"", "\"egm2008\"",
                 "4:1: E-RANGE scene.vertical_datum = \"egm2008\": expected one of \"ellipsoid\", "
                 "\"egm96\", \"scene\"");
  check_problems("vertical_datum = \"scene\"\n", "",
                 "1:1: E-REF scene.vertical_datum = missing: expected what heights count from: "
                 "\"ellipsoid\", \"egm96\" or \"scene\"");
  const TemporaryFolder folder;
  folder.write("flight.csv", "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n");
  check_problems(folder, file_trajectory(""),
                 {"@/scene.toml:25:1: E-REF trajectory.vertical_datum = missing: expected what the "
                  "file's heights count from: "
                  "\"ellipsoid\", \"egm96\" or \"scene\""});
  check_problems(folder, file_trajectory("vertical_datum = \"egm96\"\n"),
                 {"@/scene.toml:27:1: E-RANGE trajectory.vertical_datum = a datum of its own: "
                  "expected \"scene\": the scene's "
                  "heights count from an unknown level"});
}

TEST_CASE("Missing files are named with every place that was searched", "[bad_input]") {
  check_problems("material = \"short_grass\"", "elevation = \"dem.tif\"",
                 "9:1: E-IO terrain.elevation = \"dem.tif\" not found: expected a file in one of: "
                 "@; name another data folder "
                 "with --data DIR or FANBEAM_DATA");
  check_problems("[weather]", "[sensor]\nfile = \"radar.toml\"\n[weather]",
                 "23:1: E-IO sensor.file = \"radar.toml\" not found: expected a sensor file in the "
                 "scene's folder or #/sensors");
  const TemporaryFolder folder;
  folder.write("scene.toml",
               tests::replaced(tests::kSmallScene, "[[box]]",
                               "[[buildings]]\nfile = \"city/houses.geojson\"\n[[box]]"));
  const tests::Outcome outcome = tests::build(folder.path(), {folder.path() / "data", "/nowhere"});
  CHECK(tests::messages(folder, outcome.problems) ==
        std::vector<std::string>{
            "@/scene.toml:16:1: E-IO buildings[0].file = \"city/houses.geojson\" not found: "
            "expected a file in one of: "
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
    const std::string text =
        tests::replaced(tests::kSmallScene, kIls,
                        "[trajectory]\nfile = \"" + name + "\"\nvertical_datum = \"scene\"\n");
    INFO(name);
    check_problems(folder, text,
                   {"@/scene.toml:26:1: E-PATH trajectory.file = \"" + name +
                    "\": expected a path inside @ (" + reason + ")"});
  }
}

TEST_CASE("F05 a scene's name, which becomes a folder, is a safe word", "[bad_input]") {
  for (const std::string name :
       {"../../owned", "/tmp/owned", "..", ".hidden", "-o", "a b", "C:\\x", "", "\u00e4"}) {
    const std::string escaped = name == "C:\\x" ? "C:\\\\x" : name;
    check_problems("name = \"test\"", "name = \"" + escaped + "\"",
                   "2:1: E-RANGE scene.name = \"" + name +
                       "\": expected 1 to 64 letters, digits, '.', '-' and '_', the first a letter "
                       "or digit (title takes any text)");
  }
  check_problems("name = \"test\"", "name = \"a\\u001b[2J\"",
                 "2:1: E-RANGE scene.name = \"a\\x1b[2J\": expected a text without control "
                 "characters");
}

TEST_CASE("A scene without a name has that of its folder, made a safe word", "[bad_input]") {
  const TemporaryFolder folder;
  const fs::path inside = folder.path() / "My scene\x1b[2J";
  fs::create_directories(inside);
  std::ofstream(inside / "scene.toml")
      << tests::replaced(tests::kSmallScene, "name = \"test\"\n", "");
  core::ProblemList problems;
  const scenes::SceneDescription scene =
      scenes::read_scene(inside, {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  CHECK(scene.name == "My-scene--2J");
}

TEST_CASE("Exactly one kind of trajectory", "[bad_input]") {
  check_problems(kIls, "[trajectory]\n",
                 "25:2: E-REF trajectory = empty: expected exactly one of: file = \"....csv\", "
                 "[trajectory.ils], "
                 "[trajectory.fixed]");
  check_problems("[trajectory.ils]", "[trajectory.fixed]\nabove_ground_m = 3\n[trajectory.ils]",
                 "25:2: E-REF trajectory = more than one kind: expected exactly one of: file = "
                 "\"....csv\", [trajectory.ils], "
                 "[trajectory.fixed]");
}

TEST_CASE("Everything wrong in a scene and its sensor is told in one run", "[bad_input]") {
  const TemporaryFolder folder;
  folder.write("radar.toml", "name = \"half a radar\"\n[scan]\ncolumns = 0\n");
  std::string text = tests::kSmallScene;
  text = tests::replaced(text, "\"scene\"", "\"mean\"");
  text = tests::replaced(text, "half_extent_m = 2500.0", "elevation = \"dem.tif\"");
  text = tests::replaced(text, "elevation_m = 60.0", "elevation_ft = 200.0");
  text = tests::replaced(text, "height_m = 12.0", "height_m = -1.0");
  text = tests::replaced(text, "[weather]\nvisibility_m = 400.0",
                         "[sensor]\nfile = \"radar.toml\"\n[weather]\nvisibility = 3");
  const tests::Outcome outcome = tests::build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  std::vector<std::string> fields;
  for (const core::Problem& problem : outcome.problems) {
    fields.push_back(problem.field);
    CHECK(problem.place.line > 0);
    CHECK_FALSE(problem.expected.empty());
  }
  for (const char* field :
       {"scene.vertical_datum", "terrain.elevation", "runway[0].second.elevation_m",
        "runway[0].second.elevation_ft", "box[0].height_m", "weather.visibility", "scan.columns",
        "waveform.frequency_GHz"})
    CHECK(std::count(fields.begin(), fields.end(), field) == 1);
}
