// Things stand where the scene says: rays cast straight down and sideways find them in the built
// scene.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/scenes/built_scene.h"

using namespace fanbeam;
using core::radians;
using scenes::Scene;
using tests::AsciiGrid;
using tests::ground_m;
using tests::local_m;
using tests::Seen;
using tests::seen_from_above;
using tests::standing;
using tests::TemporaryFolder;

namespace {

const renderer::PointTarget& target_named(const Scene& scene, const std::string& name) {
  for (const renderer::PointTarget& target : scene.world.targets)
    if (target.name == name) return target;
  FAIL("no target " << name);
  return scene.world.targets.front();
}

}  // namespace

TEST_CASE("A box stands on the ground, without a gap, its length along its heading",
          "[object_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(standing(), "height_m = 12.0",
                              "height_m = 12.0\nheading_deg = 90.0\nwall = \"brick\""));
  // 300 m behind threshold 36 and 200 m left of the centre line; 40 m from west to east, 30 m from
  // south to north.
  const glm::dvec2 centre(-200.0, 300.0);
  const double ground = ground_m(*scene, centre);
  const Seen roof = seen_from_above(*scene, centre);
  CHECK(roof.material == "roof");
  CHECK(roof.up_m == Approx(ground + 12.0).epsilon(0.0).margin(0.01));
  CHECK(seen_from_above(*scene, centre + glm::dvec2(19.5, 14.5)).material == "roof");
  CHECK(seen_from_above(*scene, centre + glm::dvec2(20.5, 0.0)).material == "short_grass");
  CHECK(seen_from_above(*scene, centre + glm::dvec2(0.0, 15.5)).material == "short_grass");
  for (const double above_m : {0.05, 6.0, 11.9}) {
    const auto hit = scene->world.surfaces().intersect(
        glm::dvec3(centre, ground + above_m) - glm::dvec3(60, 0, 0), glm::dvec3(1, 0, 0), 200.0);
    REQUIRE(hit.has_value());
    CHECK(hit->distance_m == Approx(40.0).epsilon(0.0).margin(0.01));
    CHECK(scene->world.geometry->material_names.at(hit->material) == "brick");
    CHECK(hit->normal.x == Approx(-1.0).epsilon(0.0).margin(1e-3));
  }
}

TEST_CASE("Footprints land at their latitude and longitude, on the lowest or the mean ground",
          "[object_geometry]") {
  const TemporaryFolder folder;
  // Two houses; the ground rises 1 m in 10 m to the north.
  const AsciiGrid grid{120, 80, 9.94, 51.96, 0.001};
  grid.write(folder, "dem", [&](int, int row) {
    return core::number_text(100.0 + 11126.0 * (grid.post_y(row) - 52.0));
  });
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
)" + tests::kFixed;
  const std::unique_ptr<Scene> lowest = tests::good_scene(folder, text);
  const std::unique_ptr<Scene> mean =
      tests::good_scene(folder, tests::replaced(text, "roof = ", "base = \"mean\"\nroof = "));
  for (const auto& [latitude_deg, longitude_deg, rise_m] :
       {std::tuple{52.0101, 10.01015, 9.0}, {51.9901, 9.98015, 20.0}}) {
    const glm::dvec2 middle = local_m(*lowest, latitude_deg, longitude_deg);
    const Seen roof = seen_from_above(*lowest, middle);
    CHECK(roof.material == "metal");
    // The south wall, 0.0001 deg = 11.1 m away, stands 1.1 m lower than the middle.
    CHECK(roof.up_m == Approx(ground_m(*lowest, middle) - 1.11 + rise_m).epsilon(0.0).margin(0.1));
    CHECK(seen_from_above(*mean, middle).up_m ==
          Approx(ground_m(*mean, middle) + rise_m).epsilon(0.0).margin(0.1));
    // 0.00015 deg of longitude are 10.3 m: half a metre inside and outside the east wall.
    const double metre_deg = 0.00015 / 10.3;
    CHECK(seen_from_above(*lowest,
                          local_m(*lowest, latitude_deg, longitude_deg + 0.00015 - metre_deg / 2))
              .material == "metal");
    CHECK(seen_from_above(*lowest,
                          local_m(*lowest, latitude_deg, longitude_deg + 0.00015 + metre_deg / 2))
              .material == "short_grass");
  }
}

TEST_CASE("Places on a runway count from the displaced threshold, left of the landing direction",
          "[object_geometry]") {
  const TemporaryFolder folder;
  std::string text = tests::replaced(standing(), "elevation_m = 50.0 }\nsecond",
                                     "elevation_m = 50.0, displaced_m = 120.0 }\nsecond");
  for (const char* end : {"36", "18"})
    text = tests::replaced(
        text, "[weather]",
        std::string("[[target]]\nname = \"on ") + end + "\"\nat = { runway = \"" + end +
            "\", behind_threshold_m = 150.0, left_m = 60.0 }\nabove_ground_m = 1.5\n"
            "rcs = { shape = \"constant\", rcs_dBsm = 10.0 }\n[weather]");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  // At its own elevation: on the ground at the origin's the same degrees are 1.6 mm shorter.
  const glm::dvec3 far_end =
      scene->frame.to_local_m({core::radians(52.009), core::radians(10.0), 60.0});
  const glm::dvec3 on_36 = target_named(*scene, "on 36").position_at(0.0);
  CHECK(on_36.x == Approx(-60.0).epsilon(0.0).margin(1e-3));
  CHECK(on_36.y == Approx(270.0).epsilon(0.0).margin(1e-3));
  CHECK(on_36.z == Approx(ground_m(*scene, on_36) + 1.5).epsilon(0.0).margin(1e-6));
  const glm::dvec3 on_18 = target_named(*scene, "on 18").position_at(0.0);
  CHECK(on_18.x == Approx(60.0).epsilon(0.0).margin(1e-3));
  CHECK(on_18.y == Approx(far_end.y - 150.0).epsilon(0.0).margin(1e-3));
  CHECK(std::get<materials::ConstantRcs>(target_named(*scene, "on 18").rcs).rcs_m2 == Approx(10.0));
}

TEST_CASE("Targets turn their boresight to heading and tilt, and move along their path",
          "[object_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder,
      tests::replaced(standing(), "[weather]",
                      "[[target]]\nname = \"t\"\nheading_deg = 90.0\ntilt_deg = 30.0\nrcs = { "
                      "shape = \"trihedral\", "
                      "edge_m = 0.3 }\nwaypoint = [\n"
                      "{ time_s = 2.0, at = { runway = \"36\", behind_threshold_m = 100.0 } },\n"
                      "{ time_s = 4.0, at = { runway = \"36\", behind_threshold_m = 200.0, left_m "
                      "= 50.0 } } ]\n[weather]"));
  const renderer::PointTarget& target = target_named(*scene, "t");
  const glm::dvec3 boresight = target.axes * glm::dvec3(1, 0, 0);
  CHECK(glm::length(boresight - glm::dvec3(std::cos(radians(30.0)), 0.0, 0.5)) < 1e-12);
  CHECK(glm::length(glm::cross(glm::dvec3(target.axes[0]), glm::dvec3(target.axes[1])) -
                    glm::dvec3(target.axes[2])) < 1e-12);
  CHECK(target.position_at(0.0).y == Approx(100.0).epsilon(0.0).margin(1e-3));
  CHECK(target.position_at(3.0).y == Approx(150.0).epsilon(0.0).margin(1e-3));
  CHECK(target.position_at(3.0).x == Approx(-25.0).epsilon(0.0).margin(1e-3));
  CHECK(target.position_at(9.0).x == Approx(-50.0).epsilon(0.0).margin(1e-3));
}

TEST_CASE("A line's points share its whole cross-section and span its length",
          "[object_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder,
      tests::replaced(standing(), "[weather]",
                      "[[line]]\nname = \"wire\"\nfrom = { runway = \"36\", behind_threshold_m = "
                      "-300.0, left_m = 50.0 }\n"
                      "to = { runway = \"36\", behind_threshold_m = -300.0, left_m = -50.0 "
                      "}\nfrom_above_m = 20.0\n"
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
  CHECK(west_m == Approx(-50.0 + 100.0 / 34 / 2).epsilon(0.0).margin(1e-3));
}

TEST_CASE("The truck on Braunschweig's runway stands on it, with its materials",
          "[object_geometry]") {
  const tests::Outcome outcome =
      tests::build(std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
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

TEST_CASE("The approach starts where it should and flies over its threshold", "[object_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, tests::kSmallScene);
  const renderer::FramePose first = scene->frame_pose(0);
  CHECK(first.position_m.x == Approx(0.0).epsilon(0.0).margin(0.5));
  // The first frame's middle is 1/32 s, 2 m, after the start.
  CHECK(first.position_m.y == Approx(-1500.0 + 70.0 / 32.0).epsilon(0.0).margin(0.5));
  // 3 deg over 1500 m and 15 m at the threshold, which is 50 m high as the origin.
  CHECK(first.position_m.z ==
        Approx(15.0 + 1498.0 * std::tan(radians(3.0))).epsilon(0.0).margin(0.5));
}
