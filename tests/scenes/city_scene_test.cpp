// City models in scenes: on the ground, of the materials named, and seen as other geometry is.
#include <cmath>
#include <fstream>

#include "tests/scenes/built_scene.h"
#include "tests/terrain/city_files.h"

using namespace fanbeam;

namespace {

// The plain of the small scene around the house of city_files.h.
std::string city_scene(const std::string& keys) {
  const std::string place = "latitude_deg = 52.2496, longitude_deg = 10.4647";
  return R"([scene]
name = "city"
origin = { )" +
         place + R"(, height_m = 70.0 }
vertical_datum = "scene"
[terrain]
half_extent_m = 2500.0
spacing_m = 50.0
[[buildings]]
file = "city.json"
)" + keys +
         R"(
[trajectory.fixed]
at = { latitude_deg = 52.24, longitude_deg = 10.4647 }
above_ground_m = 60.0
)";
}

struct Town {
  tests::TemporaryFolder folder;
  tests::Outcome outcome;
  explicit Town(const nlohmann::json& city, const std::string& keys = "") {
    folder.write("city.json", city.dump());
    outcome = tests::build(folder.write("scene.toml", city_scene(keys)));
  }
  const scenes::Scene& scene() const {
    REQUIRE(outcome.scene);
    return *outcome.scene;
  }
};

}  // namespace

TEST_CASE("a building of a city model stands on the scene's ground, whatever height its file gives",
          "[cityjson]") {
  const Town town(tests::house());
  const auto& names = town.scene().world.geometry->object_names;
  CHECK(std::count(names.begin(), names.end(), "city.json house") == 1);
  REQUIRE(town.scene().world.solids().others.size() == 1);
  const terrain::Box_m& box = town.scene().world.solids().others[0];
  const glm::dvec2 middle = (glm::dvec2(box.low) + glm::dvec2(box.high)) / 2.0;
  CHECK(box.high.z - tests::ground_m(town.scene(), middle) ==
        Approx(8.0).epsilon(0.0).margin(0.01));
  CHECK(box.low.z - tests::ground_m(town.scene(), middle) ==
        Approx(-2.0).epsilon(0.0).margin(0.01));
  // On the ridge, and a metre aside of it, where the roof is 0.75 m lower.
  CHECK(tests::seen_from_above(town.scene(), middle + glm::dvec2(0.0, 0.01)).up_m ==
        Approx(box.high.z).epsilon(0.0).margin(0.02));
  const tests::Seen aside = tests::seen_from_above(town.scene(), middle + glm::dvec2(0.0, 1.0));
  CHECK(aside.up_m == Approx(box.high.z - 0.75).epsilon(0.0).margin(0.02));
  CHECK(aside.material == "roof");
}

TEST_CASE(
    "as filed, a building keeps its height, and surfaces have the materials that the scene names",
    "[cityjson]") {
  const Town town(
      tests::house(),
      "heights = \"as_filed\"\nsurfaces = { RoofSurface = \"metal\", Chimney = \"brick\" }");
  const terrain::Box_m& box = town.scene().world.solids().others.at(0);
  CHECK(town.scene().frame.to_geodetic(box.high).height_m ==
        Approx(48.0).epsilon(0.0).margin(0.01));
  CHECK(town.scene().frame.to_geodetic(box.low).height_m == Approx(40.0).epsilon(0.0).margin(0.01));
  bool told = false;
  for (const core::Problem& problem : town.outcome.problems)
    told = told || (problem.code == "W-UNUSED" && problem.value == "\"Chimney\"");
  CHECK(told);
  const auto& names = town.scene().world.geometry->material_names;
  CHECK(std::count(names.begin(), names.end(), "metal") == 1);
}

TEST_CASE("keys that the kind of a building file has no use for are told at their places",
          "[cityjson]") {
  const auto told = [](const std::string& file, const std::string& text, const std::string& keys) {
    const tests::TemporaryFolder folder;
    folder.write(file, text);
    const tests::Outcome outcome =
        tests::build_text(folder, tests::replaced(city_scene(keys), "city.json", file));
    std::vector<std::string> problems;
    for (const std::string& problem : tests::messages(folder, outcome.problems))
      problems.push_back(problem.substr(problem.find(':') + 1));
    return problems;
  };
  using Problems = std::vector<std::string>;
  const char* shed = R"({"type": "FeatureCollection", "features": [{"type": "Feature",
"properties": {"render_height": 5}, "geometry": {"type": "Polygon", "coordinates":
[[[10.464, 52.249], [10.465, 52.249], [10.465, 52.25], [10.464, 52.249]]]}}]})";
  CHECK(
      told("town.geojson", shed,
           "crs = \"EPSG:28992\"\nheights = \"as_filed\"\nsurfaces = { RoofSurface = \"metal\" }\n"
           "base = \"mean\"") ==
      Problems{"10:1: E-UNSUPPORTED buildings[0].crs = a key of CityJSON: expected no such key: "
               "town.geojson is no CityJSON",
               "11:1: E-UNSUPPORTED buildings[0].heights = a key of CityJSON: expected no such "
               "key: town.geojson is no CityJSON",
               "12:1: E-UNSUPPORTED buildings[0].surfaces = a key of CityJSON: expected no such "
               "key: town.geojson is no CityJSON"});
  CHECK(told("city.json", tests::house().dump(),
             "base = \"mean\"\nheight_property = \"h\"\nmin_height_property = \"m\"\n"
             "heights = \"as_filed\"") ==
        Problems{"10:1: E-UNSUPPORTED buildings[0].base = a key of GeoJSON footprints: expected no "
                 "such key: city.json is CityJSON",
                 "11:1: E-UNSUPPORTED buildings[0].height_property = a key of GeoJSON footprints: "
                 "expected no such key: city.json is CityJSON",
                 "12:1: E-UNSUPPORTED buildings[0].min_height_property = a key of GeoJSON "
                 "footprints: expected no such key: city.json is CityJSON"});
}

TEST_CASE("buildings beyond the terrain are counted and left out", "[cityjson]") {
  const Town town(tests::house(620000.0));
  CHECK(town.scene().world.solids().others.empty());
  REQUIRE(town.outcome.problems.size() == 1);
  CHECK(town.outcome.problems[0].code == "W-OUTSIDE");
}

TEST_CASE("A model stands at a height of the scene's datum, or above the ground, not both",
          "[models]") {
  const auto model = [](const std::string& keys) {
    return tests::replaced(tests::standing(), "[weather]",
                           "[[model]]\nfile = \"truck.gltf\"\nat = { runway = \"36\", "
                           "behind_threshold_m = 500.0, left_m = 400.0 }\n" +
                               keys + "\n[weather]");
  };
  const auto foot_m = [](const scenes::Scene& scene) {
    const terrain::Box_m& box = scene.world.solids().others.at(0);
    return scene.frame.to_geodetic(box.low).height_m;
  };
  const tests::TemporaryFolder folder;
  std::filesystem::copy_file(
      std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26/truck.gltf",
      folder.path() / "truck.gltf");
  const auto on_ground = tests::good_scene(folder, model(""));
  const glm::dvec2 there(on_ground->world.solids().others.at(0).low);
  const double ground_m = tests::height_m(*on_ground, there);
  const auto high = tests::good_scene(folder, model("above_ground_m = 30.0"));
  CHECK(foot_m(*high) - foot_m(*on_ground) == Approx(30.0).epsilon(0.0).margin(1e-3));
  const auto absolute = tests::good_scene(folder, model("height_m = 100.0"));
  CHECK(foot_m(*absolute) - foot_m(*on_ground) ==
        Approx(100.0 - ground_m).epsilon(0.0).margin(0.01));
  const tests::Outcome both =
      tests::build_text(folder, model("height_m = 100.0\nabove_ground_m = 3.0"));
  CHECK(both.scene == nullptr);
  CHECK(core::to_string(both.problems.at(0)).find("one of the two") != std::string::npos);
}
