// Names of materials and runways in a scene: all that are wrong are told in one run, each at its key.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::kSmallScene;
using tests::replaced;
using tests::TemporaryFolder;

namespace {

using Told = std::vector<std::string>;

// "9:1 terrain.material" of each problem, by line.
Told told_of(const std::string& text) {
  const TemporaryFolder folder;
  for (const char* file : {"town.geojson", "van.gltf", "cover.asc", "flight.csv"})
    folder.write(file, "");
  const tests::Outcome outcome = tests::build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  Told told;
  for (const core::Problem& problem : outcome.problems)
    told.push_back(std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) +
                   " " + problem.field);
  return told;
}

}  // namespace

// It took four runs.
TEST_CASE("A wrong name of every kind is told at once at its key beside what the reader finds",
          "[scene_names]") {
  CHECK(told_of(R"([scene]
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 50.0 }
vertical_datum = "scene"
[terrain]
half_extent_m = 2500.0
material = "brik"
generator = "rolling"
fields = ["crops", "corps"]
wood_material = "forrest"
airfield_material = "lawn"
land_cover = { file = "cover.asc", classes = { 7 = "gras" } }
[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 50.0 }
second = { name = "18", latitude_deg = 52.009, longitude_deg = 10.0, elevation_m = 60.0 }
surface = "concret"
shoulder = "dirt"
marking = "chalk"
approach_lights = "09"
[[surface]]
runway = "99"
material = "concret"
behind_threshold_m = [0.0, 100.0]
left_m = [50.0, 80.0]
[[model]]
file = "van.gltf"
at = { runway = "99", behind_threshold_m = 0.0 }
default_material = "tin"
materials = { "Glass.001" = "glas" }
[[box]]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
length_m = 40.0
width_m = 30.0
height_m = 12.0
wall = "brik"
  roof = "tiles"
[[buildings]]
file = "town.geojson"
wall = "brik"
roof = "tiles"
surfaces = { Window = "glas" }
[[target]]
at = { behind_threshold_m = 0.0, runway = "27" }
rcs = { rcs_dBsm = 0.0 }
[[target]]
rcs = { rcs_dBsm = 0.0 }
waypoint = [{ time_s = 0.0, at = { runway = "36", behind_threshold_m = 0.0 } },
  { time_s = 9.0, at = { runway = "63", behind_threshold_m = 0.0 } }]
[[line]]
from = { runway = "63", behind_threshold_m = 0.0 }
to = { runway = "81", behind_threshold_m = 9.0 }
[weather]
visibility_m = 1
[[weather.rain_cell]]
at = { runway = "63", behind_threshold_m = 0.0 }
radius_m = 500.0
rain_rate_mm_per_h = 5.0
[trajectory]
file = "flight.csv"
vertical_datum = "scene"
[trajectory.transplant]
from_latitude_deg = 50.0
from_longitude_deg = 8.5
from_elevation_m = 100.0
from_bearing_deg = 250.0
onto_runway = "62"
)") == Told{"6:1 terrain.material",
            "8:20 terrain.fields[1]",
            "9:1 terrain.wood_material",
            "10:1 terrain.airfield_material",
            "11:48 terrain.land_cover.classes.7",
            "15:1 runway[0].surface",
            "16:1 runway[0].shoulder",
            "17:1 runway[0].marking",
            "18:1 runway[0].approach_lights",
            "20:1 surface[0].runway",
            "21:1 surface[0].material",
            "26:8 model[0].at.runway",
            "27:1 model[0].default_material",
            "28:15 model[0].materials.Glass.001",
            "34:1 box[0].wall",
            "35:3 box[0].roof",
            "38:1 buildings[0].wall",
            "39:1 buildings[0].roof",
            "40:14 buildings[0].surfaces.Window",
            "42:34 target[0].at.runway",
            "47:26 target[1].waypoint[1].at.runway",
            "49:10 line[0].from.runway",
            "50:8 line[0].to.runway",
            "52:1 weather.visibility_m",
            "54:8 weather.rain_cell[0].at.runway",
            "65:1 trajectory.transplant.onto_runway"});
}

TEST_CASE("Wrong names hide nothing that is wrong on the ground, nor the other way round",
          "[scene_names]") {
  // A box off the terrain, an approach that begins off it; then a runway that is not there instead.
  std::string text = replaced(kSmallScene, "left_m = 200.0", "left_m = 2600.0");
  text = replaced(text, "\"short_grass\"", "\"brik\"");
  text = replaced(text, "height_m = 12.0", "height_m = 12.0\nroof = \"brik\"");
  CHECK(told_of(replaced(text, "start_distance_m = 1500.0", "start_distance_m = 3000.0")) ==
        Told{"9:1 terrain.material", "17:1 box[0].at", "21:1 box[0].roof", "26:2 trajectory"});
  CHECK(told_of(replaced(text, "runway = \"36\"\nstart", "runway = \"63\"\nstart")) ==
        Told{"9:1 terrain.material", "17:1 box[0].at", "21:1 box[0].roof",
             "27:1 trajectory.ils.runway"});
}

// A warning of the ground kept the flight from being looked at.
TEST_CASE("A flight beside a wrong material is told over ground with a warning too",
          "[scene_names]") {
  std::string text = replaced(kSmallScene, "\"short_grass\"", "\"brik\"");
  text = replaced(text, "start_distance_m = 1500.0", "start_distance_m = 3000.0");
  text +=
      "[[runway]]\n"  // across the other: W-OVERLAP
      "first = { name = \"01\", latitude_deg = 52.001, longitude_deg = 9.998, elevation_m = 58.0 "
      "}\n"
      "second = { name = \"19\", latitude_deg = 52.008, longitude_deg = 10.002, elevation_m = 60.0 "
      "}\n";
  const Told told = told_of(text);
  CHECK(std::count(told.begin(), told.end(), "9:1 terrain.material") == 1);
  CHECK(std::count(told.begin(), told.end(), "25:2 trajectory") == 1);
  CHECK(std::count(told.begin(), told.end(), "28:1 runway") == 1);
}

TEST_CASE("A wrong row of a flight is told beside a wrong material", "[scene_names]") {
  const TemporaryFolder folder;
  folder.write("flight.csv",
               "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n1,52.001,10,x\n");
  const std::string text = replaced(tests::file_trajectory("vertical_datum = \"scene\"\n"),
                                    "\"short_grass\"", "\"brik\"");
  const tests::Outcome outcome = tests::build_text(folder, text);
  const Told messages = tests::messages(folder, outcome.problems);
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].starts_with("@/flight.csv:3"));
  CHECK(messages[1].starts_with("@/scene.toml:9:1: E-REF terrain.material"));
}

TEST_CASE("A broken table of a runway makes no error of what refers to it", "[scene_names]") {
  const auto check_told = [](const std::string& from, const std::string& to, const Told& expected) {
    INFO(from << " -> " << to);
    CHECK(told_of(replaced(kSmallScene, from, to)) == expected);
  };
  // The box and the approach name 36.
  check_told("name = \"36\"", "name = 36", {"12:11 runway[0].first.name"});
  check_told("name = \"36\"", "name = \"3\\u001b6\"", {"12:11 runway[0].first.name"});
  check_told("name = \"36\", ", "", {"12:9 runway[0].first.name"});
  check_told("first =", "fist =", {"11:1 runway[0].first", "12:1 runway[0].fist"});
  check_told("[[runway]]", "[runway]", {"11:2 runway"});
  check_told("[[runway]]", "[[runwy]]", {"11:3 runwy"});
  check_told("[[runway]]", "[[airport]]\nfile = \"none.dat\"\nident = \"EDVE\"\n[[runwy]]",
             {"12:1 airport[0].file", "14:3 runwy"});
  // Whatever else is wrong with a runway, its ends are there to be named.
  check_told("elevation_m = 60.0", "elevation_m = \"60\"", {"13:70 runway[0].second.elevation_m"});
  const std::string no_end =
      replaced(kSmallScene, "runway = \"36\"\nstart", "runway = \"63\"\nstart");
  CHECK(told_of(replaced(no_end, "elevation_m = 60.0", "elevation_m = \"60\"")) ==
        Told{"13:70 runway[0].second.elevation_m", "26:1 trajectory.ils.runway"});
  // A reference that is none is told once.
  CHECK(told_of(replaced(kSmallScene, "runway = \"36\"\nstart", "runway = 36\nstart")) ==
        Told{"26:1 trajectory.ils.runway"});
  CHECK(told_of(replaced(kSmallScene, "runway = \"36\"\nstart", "runway = \"\"\nstart")) ==
        Told{"26:1 trajectory.ils.runway"});
}

TEST_CASE("A library with an error makes no error of the materials in it", "[scene_names]") {
  const TemporaryFolder folder;
  folder.write("mine.toml", "[brick]\na = 1\n");
  const tests::Outcome broken =
      tests::build_text(folder, "material_library = \"mine.toml\"\n" + kSmallScene);
  CHECK(broken.scene == nullptr);
  for (const core::Problem& problem : broken.problems) {
    INFO(core::to_string(problem));
    CHECK(problem.place.file == (folder.path() / "mine.toml").string());
  }
  CHECK(told_of("material_library = \"none.toml\"\n" +
                replaced(kSmallScene, "\"short_grass\"", "\"brik\"")) ==
        Told{"1:1 material_library"});
}

TEST_CASE("An interferer without a target is told once, and not for a target whose name is wrong",
          "[scene_names]") {
  const std::string carrier =
      "[[target]]\nname = \"van\"\nat = { runway = \"36\", behind_threshold_m = 0.0 }\n"
      "rcs = { rcs_dBsm = 0.0 }\n";
  const std::string other =
      kSmallScene + carrier + "[[interferer]]\ntarget = \"van\"\neirp_dBm = 10.0\n";
  CHECK(told_of(replaced(other, "target = \"van\"\n", "")) == Told{"32:1 interferer[0].target"});
  CHECK(told_of(replaced(other, "name = \"van\"", "name = 5")) == Told{"29:1 target[0].name"});
  CHECK(told_of(replaced(other, "target = \"van\"\n", "target = \"vna\"\n")) ==
        Told{"33:1 interferer[0].target"});
}

TEST_CASE("A highway's way on a runway that is not there is one error", "[scene_names]") {
  const TemporaryFolder folder;
  std::filesystem::copy_file(FANBEAM_SOURCE_DIR "/scenes/highway-76ghz/traffic.json",
                             folder.path() / "traffic.json");
  const tests::Outcome outcome = tests::build_text(
      folder, kSmallScene +
                  "[[target]]\nat = { runway = \"63\", behind_threshold_m = 0.0 }\n"
                  "rcs = { rcs_dBsm = 0.0 }\n"
                  "highway = { file = \"traffic.json\", scenario = \"H1\", target = \"D\" }\n");
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems[0].field == "target[0].at.runway");
}

TEST_CASE("A built scene keeps nothing of the text that it was read from", "[scene_names]") {
  const TemporaryFolder folder;
  CHECK_FALSE(tests::good_scene(folder, kSmallScene)->description.place_of_key);
}
