// Things stand where the scene says: rays cast straight down and sideways find them in the built scene.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/decibel.h"
#include "core/units.h"
#include "terrain/geoid.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using core::radians;
using scenes::Scene;
using tests::AsciiGrid;
using tests::TemporaryFolder;

namespace {

const glm::dvec3 kDown(0.0, 0.0, -1.0);

struct Seen {
  double up_m = 0.0;
  std::string material;
};

// What a ray from 1 km above meets first.
Seen seen_from_above(const Scene& scene, glm::dvec2 position_m) {
  const auto hit = scene.world.surfaces->intersect(glm::dvec3(position_m, 1000.0), kDown, 3000.0);
  REQUIRE(hit.has_value());
  return {1000.0 - hit->distance_m, scene.world.material_names.at(hit->material)};
}

glm::dvec2 local_m(const Scene& scene, double latitude_deg, double longitude_deg) {
  return scene.frame.to_local_m({radians(latitude_deg), radians(longitude_deg), scene.frame.origin().height_m});
}

double ground_m(const Scene& scene, glm::dvec2 position_m) {
  return scene.world.surfaces->terrain()->height_at(position_m.x, position_m.y).value();
}

// Height above the scene's datum of the terrain there.
double height_m(const Scene& scene, glm::dvec2 position_m) {
  return scene.frame.to_geodetic(glm::dvec3(position_m, ground_m(scene, position_m))).height_m;
}

const std::string kFixed = R"([trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)";

// The small scene with a standing radar.
std::string standing() {
  return tests::kSmallScene.substr(0, tests::kSmallScene.find("[trajectory.ils]")) + kFixed;
}

const renderer::PointTarget& target_named(const Scene& scene, const std::string& name) {
  for (const renderer::PointTarget& target : scene.world.targets)
    if (target.name == name) return target;
  FAIL("no target " << name);
  return scene.world.targets.front();
}

}  // namespace

TEST_CASE("T03 level ground falls below the tangent plane as the Earth does", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::string text = R"([scene]
name = "round"
origin = { latitude_deg = 47.26, longitude_deg = 11.34, height_m = 581.0 }
vertical_datum = "ellipsoid"
[terrain]
half_extent_m = 10500.0
spacing_m = 500.0
[trajectory.fixed]
at = { latitude_deg = 47.26, longitude_deg = 11.34 }
above_ground_m = 60.0
)";
  const std::unique_ptr<Scene> round = tests::good_scene(folder, text);
  // The catalogue's point 10000.9052 m east is 7.8258 m down; the fall grows with the square of the distance.
  CHECK(ground_m(*round, {10000.0, 0.0}) == Approx(-7.8258 * std::pow(10000.0 / 10000.9052, 2)).margin(0.001));
  CHECK(ground_m(*round, {5000.0, 0.0}) == Approx(-1.9565 * std::pow(5000.0 / 5000.4541, 2)).margin(0.001));
  CHECK(ground_m(*round, {0.0, 0.0}) == Approx(0.0).margin(1e-6));
  // In height above the ellipsoid it is level everywhere.
  for (const glm::dvec2 post : {glm::dvec2(10000, 10000), glm::dvec2(-10500, 2500), glm::dvec2(0, -7000)})
    CHECK(height_m(*round, post) == Approx(581.0).margin(1e-4));

  const std::unique_ptr<Scene> plane =
      tests::good_scene(folder, tests::replaced(text, "[terrain]", "earth = \"plane\"\n[terrain]"));
  CHECK(ground_m(*plane, {10000.0, -10000.0}) == Approx(0.0).margin(1e-9));
}

TEST_CASE("The runway's strip runs straight between the published elevations through rolling ground",
          "[scene_geometry]") {
  const TemporaryFolder folder;
  std::string text = tests::replaced(standing(), "material = \"short_grass\"",
                                     "generator = \"rolling\"\nrelief_m = 40.0\nwood_share = 0.0\nseed = 3");
  text = tests::replaced(text, "spacing_m = 50.0", "spacing_m = 10.0");
  text = tests::replaced(text, "elevation_m = 60.0 }", "elevation_m = 60.0 }\nstrip_half_width_m = 80.0\nblend_m = 60.0");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  const glm::dvec2 begin = local_m(*scene, 52.0, 10.0);
  const glm::dvec2 end = local_m(*scene, 52.009, 10.0);
  for (const double share : {0.02, 0.25, 0.5, 0.75, 0.98})  // a post or more from the ends, where the slope stops
    for (const double left_m : {-75.0, -30.0, 0.0, 30.0, 75.0})  // clear of the posts outside the strip
      CHECK(height_m(*scene, begin + (end - begin) * share + glm::dvec2(-left_m, 0)) ==
            Approx(50.0 + 10.0 * share).margin(0.01));
  // Beyond strip and blend the ground is as it was made.
  double largest_m = 0.0;
  for (double share = 0.0; share <= 1.0; share += 0.05)
    largest_m = std::max(largest_m, std::abs(height_m(*scene, begin + (end - begin) * share + glm::dvec2(400, 0)) -
                                             (50.0 + 10.0 * share)));
  CHECK(largest_m > 3.0);
  CHECK(largest_m < 45.0);
}

TEST_CASE("Elevations above the geoid become ellipsoidal once, and the origin is at height 0", "[scene_geometry]") {
  const tests::Outcome outcome = tests::build(std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
  REQUIRE(outcome.scene != nullptr);
  const Scene& scene = *outcome.scene;
  const double geoid_m = terrain::egm96_geoid_height_m(radians(52.320297), radians(10.575681));
  CHECK(geoid_m == Approx(43.0).margin(2.0));
  CHECK(ground_m(scene, {0.0, 0.0}) == Approx(0.0).margin(0.02));
  CHECK(height_m(scene, {0.0, 0.0}) == Approx(87.8 + geoid_m).margin(0.02));
  const glm::dvec2 far_end = local_m(scene, 52.3184010, 10.5421000);
  CHECK(height_m(scene, far_end) ==
        Approx(83.2 + terrain::egm96_geoid_height_m(radians(52.3184010), radians(10.5421000))).margin(0.05));
}

TEST_CASE("An elevation raster arrives at its own latitudes and longitudes", "[scene_geometry]") {
  const TemporaryFolder folder;
  // A plane in latitude and longitude: every interpolation reproduces it.
  const AsciiGrid grid{120, 80, 9.94, 51.96, 0.001};
  grid.write(folder, "dem", [&](int column, int row) {
    return core::number_text(100.0 + 1000.0 * (grid.post_y(row) - 52.0) - 500.0 * (grid.post_x(column) - 10.0));
  });
  const std::string text = tests::replaced(tests::replaced(standing(), "material = \"short_grass\"", "elevation = \"dem.asc\""),
                                           "[[runway]]\nfirst = { name = \"36\", latitude_deg = 52.0, longitude_deg = 10.0, "
                                           "elevation_m = 50.0 }\nsecond = { name = \"18\", latitude_deg = 52.009, "
                                           "longitude_deg = 10.0, elevation_m = 60.0 }\n",
                                           "");
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(text, "at = { runway = \"36\", behind_threshold_m = 300.0, left_m = 200.0 }",
                              "at = { latitude_deg = 52.01, longitude_deg = 10.01 }"));
  for (const auto& [latitude_deg, longitude_deg] : {std::pair{52.0, 10.0}, {52.015, 10.02}, {51.985, 9.975}, {52.01, 9.98}})
    CHECK(height_m(*scene, local_m(*scene, latitude_deg, longitude_deg)) ==
          Approx(100.0 + 1000.0 * (latitude_deg - 52.0) - 500.0 * (longitude_deg - 10.0)).margin(0.05));
}

TEST_CASE("Land cover classes give their materials at their places, the base material elsewhere", "[scene_geometry]") {
  const TemporaryFolder folder;
  // Covers the east only; forest north of 52.01, water south of it.
  const AsciiGrid grid{30, 40, 10.0, 51.97, 0.002};
  grid.write(folder, "cover", [&](int, int row) { return grid.post_y(row) > 52.01 ? "1" : "8"; });
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(standing(), "material = \"short_grass\"",
                              "material = \"gravel\"\nland_cover = { file = \"cover.asc\", classes = { 1 = \"forest\", "
                              "8 = \"water_calm\" } }"));
  CHECK(seen_from_above(*scene, local_m(*scene, 52.015, 10.02)).material == "forest");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.005, 10.02)).material == "water_calm");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0106, 10.01)).material == "forest");  // 67 m past the border
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0094, 10.01)).material == "water_calm");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0, 9.98)).material == "gravel");
}

TEST_CASE("Runway, shoulder and apron lie on the ground with their materials", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::string text = tests::replaced(standing(), "elevation_m = 60.0 }",
                                           "elevation_m = 60.0 }\nmarkings = false\nsurface = \"concrete\"\nshoulder = "
                                           "\"gravel\"\n[[surface]]\nrunway = \"36\"\nmaterial = \"asphalt_worn\"\n"
                                           "behind_threshold_m = [100.0, 300.0]\nleft_m = [60.0, 90.0]");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  // Half the width is 22.5 m, the shoulder 7.5 m more.
  for (const auto& [x_m, material] : std::vector<std::pair<double, std::string>>{
           {0, "concrete"}, {22, "concrete"}, {-22, "concrete"}, {23, "gravel"}, {-29, "gravel"}, {31, "short_grass"}}) {
    const Seen seen = seen_from_above(*scene, {x_m, 200.0});
    CHECK(seen.material == material);
    CHECK(seen.up_m == Approx(ground_m(*scene, {x_m, 200.0})).margin(0.02));
  }
  // 60 to 90 m left of the landing direction north is west.
  CHECK(seen_from_above(*scene, {-61.0, 101.0}).material == "asphalt_worn");
  CHECK(seen_from_above(*scene, {-89.0, 299.0}).material == "asphalt_worn");
  CHECK(seen_from_above(*scene, {-59.0, 200.0}).material == "short_grass");
  CHECK(seen_from_above(*scene, {-75.0, 301.0}).material == "short_grass");
  CHECK(seen_from_above(*scene, {75.0, 200.0}).material == "short_grass");
}

TEST_CASE("A box stands on the ground, without a gap, its length along its heading", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene =
      tests::good_scene(folder, tests::replaced(standing(), "height_m = 12.0", "height_m = 12.0\nheading_deg = 90.0\nwall = \"brick\""));
  // 300 m behind threshold 36 and 200 m left of the centre line; 40 m from west to east, 30 m from south to north.
  const glm::dvec2 centre(-200.0, 300.0);
  const double ground = ground_m(*scene, centre);
  const Seen roof = seen_from_above(*scene, centre);
  CHECK(roof.material == "roof");
  CHECK(roof.up_m == Approx(ground + 12.0).margin(0.01));
  CHECK(seen_from_above(*scene, centre + glm::dvec2(19.5, 14.5)).material == "roof");
  CHECK(seen_from_above(*scene, centre + glm::dvec2(20.5, 0.0)).material == "short_grass");
  CHECK(seen_from_above(*scene, centre + glm::dvec2(0.0, 15.5)).material == "short_grass");
  for (const double above_m : {0.05, 6.0, 11.9}) {
    const auto hit = scene->world.surfaces->intersect(glm::dvec3(centre, ground + above_m) - glm::dvec3(60, 0, 0),
                                                      glm::dvec3(1, 0, 0), 200.0);
    REQUIRE(hit.has_value());
    CHECK(hit->distance_m == Approx(40.0).margin(0.01));
    CHECK(scene->world.material_names.at(hit->material) == "brick");
    CHECK(hit->normal.x == Approx(-1.0).margin(1e-3));
  }
}

TEST_CASE("Footprints land at their latitude and longitude, on the lowest or the mean ground", "[scene_geometry]") {
  const TemporaryFolder folder;
  // Two houses; the ground rises 1 m in 10 m to the north.
  const AsciiGrid grid{120, 80, 9.94, 51.96, 0.001};
  grid.write(folder, "dem", [&](int, int row) { return core::number_text(100.0 + 11126.0 * (grid.post_y(row) - 52.0)); });
  folder.write("town.geojson", R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"render_height":9},"geometry":{"type":"Polygon","coordinates":
[[[10.01,52.01],[10.0103,52.01],[10.0103,52.0102],[10.01,52.0102],[10.01,52.01]]]}},
{"type":"Feature","properties":{"render_height":20,"render_min_height":5},"geometry":{"type":"Polygon","coordinates":
[[[9.98,51.99],[9.9803,51.99],[9.9803,51.9902],[9.98,51.9902],[9.98,51.99]]]}}]})");
  const std::string text = R"([scene]
name = "town"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 100.0 }
vertical_datum = "scene"
[terrain]
elevation = "dem.asc"
half_extent_m = 2500.0
spacing_m = 5.0
[[buildings]]
file = "town.geojson"
roof = "metal"
)" + kFixed;
  const std::unique_ptr<Scene> lowest = tests::good_scene(folder, text);
  const std::unique_ptr<Scene> mean = tests::good_scene(folder, tests::replaced(text, "roof = ", "base = \"mean\"\nroof = "));
  for (const auto& [latitude_deg, longitude_deg, rise_m] : {std::tuple{52.0101, 10.01015, 9.0}, {51.9901, 9.98015, 20.0}}) {
    const glm::dvec2 middle = local_m(*lowest, latitude_deg, longitude_deg);
    const Seen roof = seen_from_above(*lowest, middle);
    CHECK(roof.material == "metal");
    // The south wall, 0.0001 deg = 11.1 m away, stands 1.1 m lower than the middle.
    CHECK(roof.up_m == Approx(ground_m(*lowest, middle) - 1.11 + rise_m).margin(0.1));
    CHECK(seen_from_above(*mean, middle).up_m == Approx(ground_m(*mean, middle) + rise_m).margin(0.1));
    // 0.00015 deg of longitude are 10.3 m: half a metre inside and outside the east wall.
    const double metre_deg = 0.00015 / 10.3;
    CHECK(seen_from_above(*lowest, local_m(*lowest, latitude_deg, longitude_deg + 0.00015 - metre_deg / 2)).material == "metal");
    CHECK(seen_from_above(*lowest, local_m(*lowest, latitude_deg, longitude_deg + 0.00015 + metre_deg / 2)).material ==
          "short_grass");
  }
}

TEST_CASE("Places on a runway count from the displaced threshold, left of the landing direction", "[scene_geometry]") {
  const TemporaryFolder folder;
  std::string text = tests::replaced(standing(), "elevation_m = 50.0 }\nsecond", "elevation_m = 50.0, displaced_m = 120.0 }\nsecond");
  for (const char* end : {"36", "18"})
    text = tests::replaced(text, "[weather]", std::string("[[target]]\nname = \"on ") + end + "\"\nat = { runway = \"" + end +
                                                  "\", behind_threshold_m = 150.0, left_m = 60.0 }\nabove_ground_m = 1.5\n"
                                                  "rcs = { shape = \"constant\", rcs_dBsm = 10.0 }\n[weather]");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  const glm::dvec2 far_end = local_m(*scene, 52.009, 10.0);
  const glm::dvec3 on_36 = target_named(*scene, "on 36").position_at(0.0);
  CHECK(on_36.x == Approx(-60.0).margin(1e-3));
  CHECK(on_36.y == Approx(270.0).margin(1e-3));
  CHECK(on_36.z == Approx(ground_m(*scene, on_36) + 1.5).margin(1e-6));
  const glm::dvec3 on_18 = target_named(*scene, "on 18").position_at(0.0);
  CHECK(on_18.x == Approx(60.0).margin(1e-3));
  CHECK(on_18.y == Approx(far_end.y - 150.0).margin(1e-3));
  CHECK(std::get<materials::ConstantRcs>(target_named(*scene, "on 18").rcs).rcs_m2 == Approx(10.0));
}

TEST_CASE("Targets turn their boresight to heading and tilt, and move along their path", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(standing(), "[weather]",
                              "[[target]]\nname = \"t\"\nheading_deg = 90.0\ntilt_deg = 30.0\nrcs = { shape = \"trihedral\", "
                              "edge_m = 0.3 }\nwaypoint = [\n"
                              "{ time_s = 2.0, at = { runway = \"36\", behind_threshold_m = 100.0 } },\n"
                              "{ time_s = 4.0, at = { runway = \"36\", behind_threshold_m = 200.0, left_m = 50.0 } } ]\n[weather]"));
  const renderer::PointTarget& target = target_named(*scene, "t");
  const glm::dvec3 boresight = target.axes * glm::dvec3(1, 0, 0);
  CHECK(glm::length(boresight - glm::dvec3(std::cos(radians(30.0)), 0.0, 0.5)) < 1e-12);
  CHECK(glm::length(glm::cross(glm::dvec3(target.axes[0]), glm::dvec3(target.axes[1])) - glm::dvec3(target.axes[2])) < 1e-12);
  CHECK(target.position_at(0.0).y == Approx(100.0).margin(1e-3));
  CHECK(target.position_at(3.0).y == Approx(150.0).margin(1e-3));
  CHECK(target.position_at(3.0).x == Approx(-25.0).margin(1e-3));
  CHECK(target.position_at(9.0).x == Approx(-50.0).margin(1e-3));
}

TEST_CASE("A line's points share its whole cross-section and span its length", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(standing(), "[weather]",
                              "[[line]]\nname = \"wire\"\nfrom = { runway = \"36\", behind_threshold_m = -300.0, left_m = 50.0 }\n"
                              "to = { runway = \"36\", behind_threshold_m = -300.0, left_m = -50.0 }\nfrom_above_m = 20.0\n"
                              "to_above_m = 20.0\nrcs_dBsm_per_m = -10.0\nspacing_m = 3.0\n[weather]"));
  double sum_m2 = 0.0;
  double west_m = 0.0;
  int points = 0;
  for (const renderer::PointTarget& target : scene->world.targets) {
    if (target.name != "wire") continue;
    ++points;
    sum_m2 += std::get<materials::ConstantRcs>(target.rcs).rcs_m2;
    west_m = std::min(west_m, target.position_at(0.0).x);
  }
  CHECK(points == 34);
  CHECK(sum_m2 == Approx(10.0).epsilon(1e-6));
  CHECK(west_m == Approx(-50.0 + 100.0 / 34 / 2).margin(1e-3));
}

TEST_CASE("The truck on Braunschweig's runway stands on it, with its materials", "[scene_geometry]") {
  const tests::Outcome outcome = tests::build(std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
  REQUIRE(outcome.scene != nullptr);
  const Scene& scene = *outcome.scene;
  // 600 m behind threshold 26 on the bearing of 264.74 deg, 6 m right of the centre line.
  const double bearing = radians(264.74);
  const glm::dvec2 along(std::sin(bearing), std::cos(bearing));
  const glm::dvec2 right(along.y, -along.x);
  const glm::dvec2 truck_m = along * 600.0 + right * 6.0;
  const Seen seen = seen_from_above(scene, truck_m);
  CHECK(seen.material == "metal");
  CHECK(seen.up_m > ground_m(scene, truck_m) + 0.5);
  CHECK(seen.up_m < ground_m(scene, truck_m) + 4.5);
  CHECK(seen_from_above(scene, along * 640.0 + right * 4.0).material == "asphalt_smooth");
}

TEST_CASE("The approach starts where it should and flies over its threshold", "[scene_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, tests::kSmallScene);
  const renderer::FramePose first = scene->frame_pose(0);
  CHECK(first.position_m.x == Approx(0.0).margin(0.5));
  // The first frame's middle is 1/32 s, 2 m, after the start.
  CHECK(first.position_m.y == Approx(-1500.0 + 70.0 / 32.0).margin(0.5));
  // 3 deg over 1500 m and 15 m at the threshold, which is 50 m high as the origin.
  CHECK(first.position_m.z == Approx(15.0 + 1498.0 * std::tan(radians(3.0))).margin(0.5));
}
