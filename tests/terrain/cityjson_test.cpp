// Buildings of CityJSON: every face with its area and meaning, where the file says they stand.
#include "terrain/buildings/cityjson.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "core/constants.h"
#include "core/units.h"
#include "terrain/buildings/city_reference.h"
#include "terrain/local_frame.h"
#include "tests/shared_data.h"
#include "tests/terrain/city_files.h"

using namespace fanbeam;
using nlohmann::json;
using terrain::CityModel;

namespace {

struct Read {
  CityModel city;
  std::vector<core::Problem> problems;
  bool has(const std::string& code, const std::string& text) const {
    for (const core::Problem& problem : problems)
      if (problem.code == code && to_string(problem).find(text) != std::string::npos) return true;
    return false;
  }
};

Read read_text(const std::string& text, const std::string& crs = "") {
  // Around the first corner; lengths of the frame are true to 1e-6 there, the map's to its scale (4e-4).
  std::optional<terrain::LocalFrame> frame;
  const auto local_m = [&](const core::Geodetic& position) {
    if (!frame) frame.emplace(position, terrain::EarthModel::wgs84);
    return frame->to_local_m(position);
  };
  Read read;
  core::ProblemList problems;
  try {
    read.city = terrain::read_cityjson(text, "city.json", {crs, local_m}, problems);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
  read.problems = problems.all();
  return read;
}

Read read(const json& city, const std::string& crs = "") { return read_text(city.dump(), crs); }

// By surface.
std::map<std::string, double> areas_m2(const CityModel& city) {
  std::map<std::string, double> areas;
  for (const terrain::CityBuilding& building : city.buildings)
    for (std::size_t i = 0; i < building.triangles.size(); ++i) {
      const glm::uvec3& t = building.triangles[i];
      const glm::dvec3& a = building.vertices_m[t.x];
      areas[city.surfaces[building.triangle_surface[i]]] +=
          glm::length(glm::cross(building.vertices_m[t.y] - a, building.vertices_m[t.z] - a)) / 2;
    }
  return areas;
}

// Of all that triangles enclose with the plane z = 0, outward normals counted.
double volume_m3(const terrain::CityBuilding& building) {
  double sum_m3 = 0.0;
  for (const glm::uvec3& t : building.triangles)
    sum_m3 += glm::dot(building.vertices_m[t.x],
                       glm::cross(building.vertices_m[t.y], building.vertices_m[t.z])) /
              6;
  return sum_m3;
}

// The part is the house once more.
json house_with_part() {
  json city = tests::house();
  json& objects = city["CityObjects"];
  objects["part"] = objects["house"];
  objects["part"]["type"] = "BuildingPart";
  objects["part"]["parents"] = {"house"};
  return city;
}

}  // namespace

TEST_CASE("a house of CityJSON has the areas, the volume and the surfaces of its closed form",
          "[cityjson]") {
  const Read house = read(tests::house());
  CHECK(house.problems.empty());
  REQUIRE(house.city.buildings.size() == 1);
  CHECK(house.city.buildings[0].id == "house");
  const auto areas = areas_m2(house.city);
  REQUIRE(areas.size() == 2);  // the ground is not seen
  // Two sides of 12 m x 5 m, two gables of 8 m x 5 m and a triangle of 8 m x 3 m; roofs 12 m x 5 m.
  // UTM shrinks lengths by 4e-4 less near the zone's edge: 2e-3 covers it in areas.
  CHECK(areas.at("WallSurface") == Approx(2 * 60.0 + 2 * (40.0 + 12.0)).epsilon(2e-3));
  CHECK(areas.at("RoofSurface") == Approx(2 * 12.0 * 5.0).epsilon(2e-3));
  // Closed but for the ground, which lies in the plane of the first corner.
  CHECK(volume_m3(house.city.buildings[0]) ==
        Approx(12.0 * 8.0 * 5.0 + 12.0 * 8.0 * 3.0 / 2).epsilon(3e-3));
}

TEST_CASE(
    "a wall with a window that is a hole loses the hole's area, and the window has its own name",
    "[cityjson]") {
  json city = tests::house();
  const auto first = city["vertices"].size();
  for (const auto& corner :
       {std::array{4000, 0, 1000}, {6000, 0, 1000}, {6000, 0, 3000}, {4000, 0, 3000}})
    city["vertices"].push_back(corner);
  json& geometry = city["CityObjects"]["house"]["geometry"][0];
  geometry["boundaries"][0][1].push_back({first + 3, first + 2, first + 1, first});
  geometry["boundaries"][0].push_back({{first, first + 1, first + 2, first + 3}});
  geometry["semantics"]["surfaces"].push_back({{"type", "Window"}});
  geometry["semantics"]["values"][0].push_back(3);
  const auto areas = areas_m2(read(city).city);
  CHECK(areas.at("Window") == Approx(4.0).epsilon(2e-3));
  CHECK(areas.at("WallSurface") == Approx(224.0 - 4.0).epsilon(2e-3));
}

TEST_CASE("parts belong to their building, of each the highest level of detail that is known",
          "[cityjson]") {
  json city = tests::house();
  json part = city["CityObjects"]["house"];
  json coarse = part["geometry"][0];
  coarse["lod"] = "1.2";
  coarse["boundaries"][0].erase(6);  // would miss a roof
  json indoors = coarse;
  indoors["lod"] = "4";
  part["type"] = "BuildingPart";
  part["parents"] = {"house"};
  part["geometry"] = {coarse, part["geometry"][0], indoors};
  city["CityObjects"]["part"] = part;
  city["CityObjects"]["house"]["children"] = {"part"};
  city["CityObjects"]["house"].erase("geometry");
  city["CityObjects"]["road"] = {{"type", "Road"}};
  const Read found = read(city);
  REQUIRE(found.city.buildings.size() == 1);
  CHECK(found.city.buildings[0].id == "house");
  CHECK(areas_m2(found.city).at("RoofSurface") == Approx(120.0).epsilon(2e-3));
  CHECK(found.has("W-SKIPPED", "1 Road"));
  CHECK_FALSE(found.has("W-SKIPPED", "LoD"));
}

// CityJSON 2.0.2, CityObjectGroup: children name the group among their parents. All its buildings were one.
TEST_CASE("buildings of a group stay buildings of their own, and parts find theirs behind it",
          "[cityjson]") {
  json city = tests::house();
  json& objects = city["CityObjects"];
  objects["block"] = {{"type", "CityObjectGroup"}, {"children", {"house", "other", "part"}}};
  objects["other"] = objects["house"];
  objects["part"] = objects["house"];
  objects["part"]["type"] = "BuildingPart";
  for (const char* id : {"house", "other"}) objects[id]["parents"] = {"block"};
  objects["part"]["parents"] = {"block", "other"};
  const Read found = read(city);
  REQUIRE(found.city.buildings.size() == 2);
  CHECK(found.city.buildings[0].id == "house");
  CHECK(found.city.buildings[1].id == "other");
  CHECK(found.city.buildings[1].triangles.size() == 2 * found.city.buildings[0].triangles.size());
  CHECK(found.has("W-SKIPPED", "1 CityObjectGroup"));
}

// CityJSON 2.0.2, Building: installations may have a room as parent, parts of IFC files a storey. What hung there was a
// building of its own, put on the ground.
TEST_CASE(
    "what hangs under a room, a storey or an extension's building belongs to the same building",
    "[cityjson]") {
  for (const char* between : {"BuildingRoom", "BuildingStorey", "BuildingUnit", "+Wing"}) {
    INFO(between);
    json city = tests::house();
    json& objects = city["CityObjects"];
    objects["balcony"] = objects["house"];
    objects["balcony"]["type"] = "BuildingInstallation";
    objects["balcony"]["parents"] = {"between"};
    objects["between"] = {{"type", between}, {"parents", {"house"}}};
    const Read found = read(city);
    REQUIRE(found.city.buildings.size() == 1);
    CHECK(found.city.buildings[0].id == "house");
    CHECK(areas_m2(found.city).at("RoofSurface") == Approx(240.0).epsilon(2e-3));
    // Of several parents the one that is built counts.
    objects["between"].erase("parents");
    objects["balcony"]["parents"] = {"between", "house"};
    REQUIRE(read(city).city.buildings.size() == 1);
    CHECK(read(city).city.buildings[0].id == "house");
  }
}

// CityJSON 2.0.2, Geometry Objects: several of one lod stand for a MultiGeometry. The first alone was read.
TEST_CASE("all geometries of the highest level of detail are read", "[cityjson]") {
  json city = tests::house();
  json& geometries = city["CityObjects"]["house"]["geometry"];
  json floor = json::parse(R"({"type": "MultiSurface", "boundaries": [[[4, 5, 6, 7]]],
    "semantics": {"surfaces": [{"type": "OuterFloorSurface"}], "values": [0]}})");
  for (const char* lod : {"2.1", "2.2"}) {
    floor["lod"] = lod;
    geometries.push_back(floor);
  }
  const auto areas = areas_m2(read(city).city);
  CHECK(areas.at("RoofSurface") == Approx(120.0).epsilon(2e-3));
  CHECK(areas.at("OuterFloorSurface") == Approx(12.0 * 8.0).epsilon(2e-3));
}

TEST_CASE("a building's block does not hide its finer parts, and coarser parts stay",
          "[cityjson]") {
  json city = house_with_part();
  json& objects = city["CityObjects"];
  const auto with_lods = [&](const char* building, const char* part) {
    objects["house"]["geometry"][0]["lod"] = building;
    objects["part"]["geometry"][0]["lod"] = part;
    return read(city);
  };
  const Read finer = with_lods("1.2", "2.2");
  REQUIRE(finer.city.buildings.size() == 1);
  CHECK(finer.city.buildings[0].id == "house");
  CHECK(areas_m2(finer.city).at("RoofSurface") == Approx(120.0).epsilon(2e-3));
  CHECK(finer.has("W-SKIPPED", "buildings coarser than their parts = 1"));
  for (const char* part : {"1.2", "2.2", "2.3"}) {
    INFO(part);
    const Read both = with_lods("2.2", part);
    CHECK(areas_m2(both.city).at("RoofSurface") == Approx(240.0).epsilon(2e-3));
    CHECK(both.problems.empty());
  }
}

// Where the reconstruction of a part had failed, three quarters of the building were missing.
TEST_CASE("a building's block stays where one of its parts has nothing in its place",
          "[cityjson]") {
  json city = house_with_part();
  json& objects = city["CityObjects"];
  objects["house"]["geometry"][0]["lod"] = "1.2";
  objects["footprint"] = objects["part"];
  json& footprint = objects["footprint"]["geometry"][0];
  footprint =
      json::parse(R"({"type": "MultiSurface", "lod": "0", "boundaries": [[[0, 3, 2, 1]]]})");
  const Read without = read(city);
  REQUIRE(without.city.buildings.size() == 1);
  CHECK(areas_m2(without.city).at("RoofSurface") == Approx(240.0).epsilon(2e-3));
  CHECK_FALSE(without.has("W-SKIPPED", "coarser"));
  CHECK(without.has("W-SKIPPED", "buildings without surfaces of LoD 1 to 3 = 1"));
  // A ground of a finer level is none that is seen, a part's own part is.
  footprint["lod"] = "2.2";
  footprint["semantics"] =
      json::parse(R"({"surfaces": [{"type": "GroundSurface"}], "values": [0]})");
  CHECK(areas_m2(read(city).city).at("RoofSurface") == Approx(240.0).epsilon(2e-3));
  objects["footprint"].erase("geometry");
  objects["part"]["parents"] = {"footprint"};
  const Read within = read(city);
  REQUIRE(within.city.buildings.size() == 1);
  CHECK(areas_m2(within.city).at("RoofSurface") == Approx(120.0).epsilon(2e-3));
  CHECK(within.has("W-SKIPPED", "buildings coarser than their parts = 1"));
}

TEST_CASE("surfaces without semantics are told apart by how they stand", "[cityjson]") {
  json city = tests::house();
  city["CityObjects"]["house"]["geometry"][0].erase("semantics");
  const auto areas = areas_m2(read(city).city);
  REQUIRE(areas.size() == 2);
  CHECK(areas.at("WallSurface") == Approx(224.0).epsilon(2e-3));
  CHECK(areas.at("RoofSurface") == Approx(120.0).epsilon(2e-3));
}

TEST_CASE("Dutch coordinates stand where the land registry's formulas put them", "[cityjson]") {
  // F. H. Schreutelkamp and G. L. Strang van Hees, "Benaderingsformules voor de transformatie tussen RD- en
  // WGS84-kaartcoordinaten" (2001): X 155000, Y 463000 is 52.15517440 N, 5.38720621 E; good to half a metre.
  for (const int epsg : {28992, 7415}) {
    const auto at = terrain::to_wgs84({{155000.0, 463000.0, 12.5}}, epsg, {});
    REQUIRE(at[0].has_value());
    CHECK(core::degrees(at[0]->latitude_rad) == Approx(52.15517440).epsilon(0.0).margin(1e-5));
    CHECK(core::degrees(at[0]->longitude_rad) == Approx(5.38720621).epsilon(0.0).margin(1.5e-5));
    CHECK(at[0]->height_m == 12.5);
  }
  // US survey feet, in the plane and above it.
  CHECK(terrain::to_wgs84({{980000.0, 200000.0, 100.0}}, 2263, {})[0]->height_m ==
        Approx(100.0 * 1200.0 / 3937.0).epsilon(1e-12));
  CHECK_FALSE(terrain::to_wgs84({{1e300, 0.0, 0.0}}, 28992, {})[0].has_value());
}

TEST_CASE("reference systems are read from every form that CityJSON had, and no file gets to PROJ",
          "[cityjson]") {
  CHECK(terrain::epsg_code("https://www.opengis.net/def/crs/EPSG/0/7415") == 7415);
  CHECK(terrain::epsg_code("urn:ogc:def:crs:EPSG::28992") == 28992);
  CHECK(terrain::epsg_code("EPSG:4979") == 4979);
  for (const char* text : {"", "EPSG", "EPSG:", "EPSG:-1", "EPSG:1.5", "EPSG:/etc/passwd",
                           "+init=file:1", "EPSG:nan", "EPSG:1e300"})
    CHECK_FALSE(terrain::epsg_code(text).has_value());
  json city = tests::house();
  city.erase("metadata");
  CHECK(read(city).has("E-REF", "crs = \"EPSG:...\" in the scene"));
  CHECK(read(city, "EPSG:25832").problems.empty());
  CHECK(read(city, "EPSG:999999").has("E-REF", "EPSG:999999"));
  CHECK(read(city, "EPSG:4978").has("E-UNSUPPORTED", "the Earth's centre"));
}

TEST_CASE("all that is wrong with a CityJSON file is told at once, each with its place",
          "[cityjson]") {
  json city = tests::house();
  json& geometry = city["CityObjects"]["house"]["geometry"][0];
  geometry["boundaries"][0][0][0] = {0, 1, 99};
  geometry["boundaries"][0][1][0] = {0, 1, "two"};
  geometry["semantics"]["values"][0][2] = 7;
  city["CityObjects"]["other"] = {{"type", "Building"},
                                  {"parents", {"nobody"}},
                                  {"geometry", city["CityObjects"]["house"]["geometry"]}};
  const Read found = read(city);
  CHECK(found.city.buildings.empty());
  CHECK_FALSE(
      found.has("E-RANGE", "/CityObjects/house/geometry/0/boundaries/0/0/0/2"));  // a ground
  CHECK(found.has("E-PARSE", "/CityObjects/house/geometry/0/boundaries/0/1/0/2"));
  CHECK(found.has("E-RANGE", "/CityObjects/house/geometry/0/semantics/values/0/2"));
  CHECK(found.has("E-REF", "/CityObjects/other/parents/0"));

  json old = tests::house();
  old["version"] = "1.0";
  old.erase("vertices");
  CHECK(read(old).has("E-UNSUPPORTED", "\"1.1\" or \"2.0\""));
  json turning = tests::house();
  turning["CityObjects"]["house"]["parents"] = {"house"};
  CHECK(read(turning).has("E-REF", "no ring of parents"));
  json far = tests::house();
  far["vertices"][1] = {1e15, 0, 0};
  CHECK(read(far).has("E-RANGE", "vertices/1/0"));
  far["vertices"][1] = {1e11, 0, 0};
  CHECK(read(far).has("E-RANGE", "a place on the Earth"));
  CHECK(read_text("{\"type\": \"CityJSON\", ").has("E-PARSE", "city.json:1:"));
}

TEST_CASE("a system that is named beside another one of the file is told to be of no use",
          "[cityjson]") {
  CHECK(read(tests::house(), "EPSG:28992")
            .has("W-UNUSED", "crs = \"EPSG:28992\": the file says EPSG:25832"));
  CHECK(read(tests::house(), "EPSG:25832").problems.empty());
}

TEST_CASE("values of another type than CityJSON's are refused, not left out", "[cityjson]") {
  json city = tests::house();
  city["CityObjects"]["house"]["geometry"][0]["semantics"]["values"] = "x";
  CHECK(read(city).has("E-PARSE", "semantics/values = \"x\""));
  city = tests::house();
  city["CityObjects"]["house"]["geometry"] = "none";
  CHECK(read(city).has("E-PARSE", "/CityObjects/house/geometry"));
  city = tests::house();
  city["CityObjects"] = json::array();
  CHECK(read(city).has("E-PARSE", "/CityObjects"));
}

TEST_CASE("faces with too many corners are E-LIMIT, one alone and all together", "[cityjson]") {
  const auto rounds = [](int corners, int faces) {
    json city = tests::house();
    json ring = json::array();
    for (int i = 0; i < corners; ++i) {
      const double angle_rad = 2.0 * core::kPi * i / corners;
      ring.push_back(city["vertices"].size());
      city["vertices"].push_back(
          {std::lround(1e5 * std::cos(angle_rad)), std::lround(1e5 * std::sin(angle_rad)), 9000});
    }
    json& geometry = city["CityObjects"]["house"]["geometry"][0];
    geometry.erase("semantics");
    json face = json::array(), shell = json::array();
    face.push_back(ring);
    for (int i = 0; i < faces; ++i) shell.push_back(face);
    geometry["boundaries"] = json::array();
    geometry["boundaries"].push_back(shell);
    return read(city);
  };
  CHECK(rounds(4001, 1).has("E-LIMIT", "boundaries/0/0 = 4001 corners: expected at most 4000"));
  CHECK(rounds(4000, 1).city.buildings.size() == 1);
  CHECK(rounds(4000, 2).has("E-LIMIT", "boundaries/0/1 = 4000 corners"));
}

TEST_CASE("faces without area or across themselves cost a warning, not the building",
          "[cityjson]") {
  json city = tests::house();
  json& faces = city["CityObjects"]["house"]["geometry"][0]["boundaries"][0];
  faces[1] = {{0, 1, 1, 0}};
  const Read found = read(city);
  CHECK(found.has("W-DEGENERATE", "faces without area = 1"));
  CHECK(areas_m2(found.city).at("WallSurface") == Approx(224.0 - 60.0).epsilon(2e-3));
}

TEST_CASE("CityJSON is known by its own word alone", "[cityjson]") {
  CHECK(terrain::is_cityjson(R"({"CityObjects": {}, "type" : "CityJSON"})"));
  CHECK_FALSE(terrain::is_cityjson(R"({"type": "FeatureCollection", "name": "CityJSON"})"));
  CHECK_FALSE(terrain::is_cityjson("\"CityJSON\""));
}

TEST_CASE(
    "published city models: every face of Rotterdam's and Delft's buildings, by Newell's areas",
    "[cityjson][data]") {
  struct Sample {
    const char* file;
    const char* crs;
    std::size_t buildings;
    bool has_grounds;
  };
  for (const Sample& sample : {Sample{"rotterdam_subset.json", "EPSG:28992", 16, true},
                               Sample{"delft.json", "", 163, false}}) {
    const auto path = tests::shared_data(std::string("cityjson-rotterdam/") + sample.file);
    if (!path) return;
    std::ifstream stream(*path);
    std::stringstream text;
    text << stream.rdbuf();
    const Read found = read_text(text.str(), sample.crs);
    INFO(sample.file);
    for (const core::Problem& problem : found.problems) CHECK_FALSE(problem.is_error());
    CHECK(found.city.buildings.size() == sample.buildings);

    // The same from the file's own numbers; holes have the opposite sense.
    const json city = json::parse(text.str());
    double expected_m2 = 0.0, ground_m2 = 0.0;
    const auto add = [&](const json& face, const std::string& semantic) {
      double area_m2 = 0.0;
      bool up = true, flat = false;
      for (std::size_t r = 0; r < face.size(); ++r) {
        glm::dvec3 sum(0.0);
        const auto point = [&](std::size_t k) {
          const json& v = city["vertices"][face[r][k % face[r].size()].get<std::size_t>()];
          return glm::dvec3(v[0], v[1], v[2]) * city["transform"]["scale"][0].get<double>();
        };
        for (std::size_t k = 0; k < face[r].size(); ++k)
          sum += glm::cross(point(k) - point(0), point(k + 1) - point(0)) / 2.0;
        area_m2 += (r == 0 ? 1.0 : -1.0) * glm::length(sum);
        if (r == 0) {
          up = sum.z > 0.0;
          flat = std::abs(sum.z) > 0.5 * glm::length(sum);
        }
      }
      const bool ground = semantic.empty() ? flat && !up : semantic == "GroundSurface";
      (ground ? ground_m2 : expected_m2) += area_m2;
    };
    for (const auto& [id, object] : city["CityObjects"].items()) {
      const std::string type = object["type"];
      if (type != "Building" && type != "Bridge") continue;
      const json& geometry = object["geometry"][0];
      const bool solid = geometry["type"] == "Solid";
      const json& faces = solid ? geometry["boundaries"][0] : geometry["boundaries"];
      for (std::size_t i = 0; i < faces.size(); ++i) {
        std::string semantic;
        if (geometry.contains("semantics"))
          semantic = geometry["semantics"]["surfaces"]
                             [geometry["semantics"]["values"][i].get<std::size_t>()]["type"];
        add(faces[i], semantic);
      }
    }
    double read_m2 = 0.0;
    for (const auto& [surface, area] : areas_m2(found.city)) read_m2 += area;
    CHECK((ground_m2 > 0.0) == sample.has_grounds);
    CHECK(read_m2 == Approx(expected_m2).epsilon(1e-3));  // the map's scale is 0.9999 there
  }
}
