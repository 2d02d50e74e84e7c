// The ground of built scenes: its curvature, its datum, its rasters, the strip of the runway.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "terrain/geoid.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;
using core::radians;
using scenes::Scene;
using tests::AsciiGrid;
using tests::ground_m;
using tests::height_m;
using tests::local_m;
using tests::Seen;
using tests::seen_from_above;
using tests::standing;
using tests::TemporaryFolder;

namespace {

const std::string kLevelGround = R"([scene]
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

}  // namespace

TEST_CASE("T03 level ground falls below the tangent plane as the Earth does", "[ground_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> round = tests::good_scene(folder, kLevelGround);
  // The catalogue's point 10000.9052 m east is 7.8258 m down; the fall grows with the square of the
  // distance.
  CHECK(ground_m(*round, {10000.0, 0.0}) ==
        Approx(-7.8258 * std::pow(10000.0 / 10000.9052, 2)).epsilon(0.0).margin(0.001));
  CHECK(ground_m(*round, {5000.0, 0.0}) ==
        Approx(-1.9565 * std::pow(5000.0 / 5000.4541, 2)).epsilon(0.0).margin(0.001));
  CHECK(ground_m(*round, {0.0, 0.0}) == Approx(0.0).epsilon(0.0).margin(1e-6));
  // In height above the ellipsoid it is level everywhere.
  for (const glm::dvec2 post :
       {glm::dvec2(10000, 10000), glm::dvec2(-10500, 2500), glm::dvec2(0, -7000)})
    CHECK(height_m(*round, post) == Approx(581.0).epsilon(0.0).margin(1e-4));

  const std::unique_ptr<Scene> plane = tests::good_scene(
      folder, tests::replaced(kLevelGround, "[terrain]", "earth = \"plane\"\n[terrain]"));
  CHECK(ground_m(*plane, {10000.0, -10000.0}) == Approx(0.0).epsilon(0.0).margin(1e-9));
}

TEST_CASE("Ground level above the geoid follows it from post to post on a plane Earth too",
          "[ground_geometry]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> level = tests::good_scene(
      folder, tests::replaced(tests::replaced(kLevelGround, "\"ellipsoid\"", "\"egm96\""),
                              "[terrain]", "earth = \"plane\"\n[terrain]"));
  const auto geoid_m = [&](glm::dvec2 post) {
    const core::Geodetic at = level->frame.to_geodetic({post, 0.0});
    return terrain::egm96_geoid_height_m(at.latitude_rad, at.longitude_rad);
  };
  CHECK(std::abs(geoid_m({10000, 10000}) - geoid_m({0, -7000})) > 0.2);
  for (const glm::dvec2 post : {glm::dvec2(10000, 10000), glm::dvec2(0, -7000)})
    CHECK(height_m(*level, post) == Approx(581.0 + geoid_m(post)).epsilon(0.0).margin(1e-4));
}

TEST_CASE(
    "The runway's strip runs straight between the published elevations through rolling ground",
    "[ground_geometry]") {
  const TemporaryFolder folder;
  std::string text =
      tests::replaced(standing(), "material = \"short_grass\"",
                      "generator = \"rolling\"\nrelief_m = 40.0\nwood_share = 0.0\nseed = 3");
  text = tests::replaced(text, "spacing_m = 50.0", "spacing_m = 10.0");
  text = tests::replaced(text, "elevation_m = 60.0 }",
                         "elevation_m = 60.0 }\nstrip_half_width_m = 80.0\nblend_m = 60.0");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  const glm::dvec2 begin = local_m(*scene, 52.0, 10.0);
  const glm::dvec2 end = local_m(*scene, 52.009, 10.0);
  for (const double share :
       {0.02, 0.25, 0.5, 0.75, 0.98})  // a post or more from the ends, where the slope stops
    for (const double left_m :
         {-75.0, -30.0, 0.0, 30.0, 75.0})  // clear of the posts outside the strip
      CHECK(height_m(*scene, begin + (end - begin) * share + glm::dvec2(-left_m, 0)) ==
            Approx(50.0 + 10.0 * share).epsilon(0.0).margin(0.01));
  // Beyond strip and blend the ground is as it was made.
  double largest_m = 0.0;
  for (double share = 0.0; share <= 1.0; share += 0.05)
    largest_m = std::max(
        largest_m, std::abs(height_m(*scene, begin + (end - begin) * share + glm::dvec2(400, 0)) -
                            (50.0 + 10.0 * share)));
  CHECK(largest_m > 3.0);
  CHECK(largest_m < 45.0);
}

TEST_CASE("Runways that cross at two heights are told, and blended in either order",
          "[ground_geometry]") {
  const std::string runway = "[[runway]]\nfirst = { name = \"36\"";
  const auto crossing = [](const std::string& elevation) {
    return "[[runway]]\nfirst = { name = \"09\", latitude_deg = 52.0045, longitude_deg = 9.99, "
           "elevation_m = " +
           elevation +
           " }\nsecond = { name = \"27\", latitude_deg = 52.0045, "
           "longitude_deg = 10.01, elevation_m = " +
           elevation + " }\n";
  };
  const auto overlaps = [](const tests::Outcome& outcome) {
    std::vector<std::string> told;
    for (const core::Problem& problem : outcome.problems)
      if (problem.code == "W-OVERLAP") told.push_back(problem.value);
    return told;
  };
  const std::string text = standing();
  const TemporaryFolder folder;
  const tests::Outcome before =
      tests::build_text(folder, tests::replaced(text, runway, crossing("65.0") + runway));
  const tests::Outcome behind =
      tests::build_text(folder, tests::replaced(text, "[[box]]", crossing("65.0") + "[[box]]"));
  REQUIRE(before.scene != nullptr);
  REQUIRE(behind.scene != nullptr);
  // 36/18 is at 55 m in the middle, and rises 1 % along the 150 m of the other's strip.
  CHECK(overlaps(before) ==
        std::vector<std::string>{"09/27 and 36/18 differ by 10.7 m where their strips overlap"});
  CHECK(overlaps(behind) ==
        std::vector<std::string>{"36/18 and 09/27 differ by 10.7 m where their strips overlap"});
  for (const auto& [latitude_deg, longitude_deg] :
       {std::pair{52.0045, 10.0}, {52.0042, 10.0004}, {52.0048, 9.9993}, {52.002, 10.0}}) {
    const glm::dvec2 at_m = local_m(*before.scene, latitude_deg, longitude_deg);
    CHECK(height_m(*before.scene, at_m) ==
          Approx(height_m(*behind.scene, at_m)).epsilon(0.0).margin(1e-6));
  }
  CHECK(height_m(*behind.scene, local_m(*behind.scene, 52.0045, 10.0)) ==
        Approx(60.0).epsilon(0.0).margin(1.0));
  const tests::Outcome level =
      tests::build_text(folder, tests::replaced(text, "[[box]]", crossing("55.0") + "[[box]]"));
  CHECK(overlaps(level).size() == 1);  // 0.75 m at the borders
  const std::string flat = tests::replaced(text, "elevation_m = 60.0", "elevation_m = 50.0");
  CHECK(overlaps(tests::build_text(folder,
                                   tests::replaced(flat, "[[box]]", crossing("50.0") + "[[box]]")))
            .empty());
  // Nobody can change the strips of [[airport]]: told from 2 m on.
  for (const bool high : {false, true}) {
    folder.write("scene.toml",
                 tests::replaced(text, "[[box]]", crossing(high ? "65.0" : "55.0") + "[[box]]"));
    core::ProblemList problems;
    scenes::SceneDescription description =
        scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
    for (scenes::RunwayDescription& each : description.runways) each.from_airport = true;
    tests::Outcome outcome;
    outcome.scene = scenes::build_scene(description, {}, problems);
    outcome.problems = problems.all();
    CHECK(overlaps(outcome).size() == (high ? 1 : 0));
  }
}

TEST_CASE("Elevations above the geoid become ellipsoidal once, and the origin is at height 0",
          "[ground_geometry]") {
  const tests::Outcome outcome =
      tests::build(std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
  REQUIRE(outcome.scene != nullptr);
  const Scene& scene = *outcome.scene;
  const double geoid_m = terrain::egm96_geoid_height_m(radians(52.320297), radians(10.575681));
  CHECK(geoid_m == Approx(43.0).epsilon(0.0).margin(2.0));
  CHECK(ground_m(scene, {0.0, 0.0}) == Approx(0.0).epsilon(0.0).margin(0.02));
  CHECK(height_m(scene, {0.0, 0.0}) == Approx(87.8 + geoid_m).epsilon(0.0).margin(0.02));
  const glm::dvec2 far_end = local_m(scene, 52.3184010, 10.5421000);
  CHECK(height_m(scene, far_end) ==
        Approx(83.2 + terrain::egm96_geoid_height_m(radians(52.3184010), radians(10.5421000)))
            .epsilon(0.0)
            .margin(0.05));
}

TEST_CASE("An elevation raster arrives at its own latitudes and longitudes", "[ground_geometry]") {
  const TemporaryFolder folder;
  // A plane in latitude and longitude: every interpolation reproduces it.
  const AsciiGrid grid{120, 80, 9.94, 51.96, 0.001};
  grid.write(folder, "dem", [&](int column, int row) {
    return core::number_text(100.0 + 1000.0 * (grid.post_y(row) - 52.0) -
                             500.0 * (grid.post_x(column) - 10.0));
  });
  const std::string text = tests::replaced(
      tests::replaced(standing(), "material = \"short_grass\"", "elevation = \"dem.asc\""),
      "[[runway]]\nfirst = { name = \"36\", latitude_deg = 52.0, longitude_deg = 10.0, "
      "elevation_m = 50.0 }\nsecond = { name = \"18\", latitude_deg = 52.009, "
      "longitude_deg = 10.0, elevation_m = 60.0 }\n",
      "");
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder,
      tests::replaced(text, "at = { runway = \"36\", behind_threshold_m = 300.0, left_m = 200.0 }",
                      "at = { latitude_deg = 52.01, longitude_deg = 10.01 }"));
  for (const auto& [latitude_deg, longitude_deg] :
       {std::pair{52.0, 10.0}, {52.015, 10.02}, {51.985, 9.975}, {52.01, 9.98}})
    CHECK(height_m(*scene, local_m(*scene, latitude_deg, longitude_deg)) ==
          Approx(100.0 + 1000.0 * (latitude_deg - 52.0) - 500.0 * (longitude_deg - 10.0))
              .epsilon(0.0)
              .margin(0.05));
}

TEST_CASE("Land cover classes give their materials at their places, the base material elsewhere",
          "[ground_geometry]") {
  const TemporaryFolder folder;
  // Covers the east only; forest north of 52.01, water south of it.
  const AsciiGrid grid{30, 40, 10.0, 51.97, 0.002};
  grid.write(folder, "cover", [&](int, int row) { return grid.post_y(row) > 52.01 ? "1" : "8"; });
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder,
      tests::replaced(
          standing(), "material = \"short_grass\"",
          "material = \"gravel\"\nland_cover = { file = \"cover.asc\", classes = { 1 = \"forest\", "
          "8 = \"water_calm\" } }"));
  CHECK(seen_from_above(*scene, local_m(*scene, 52.015, 10.02)).material == "forest");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.005, 10.02)).material == "water_calm");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0106, 10.01)).material ==
        "forest");  // 67 m past the border
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0094, 10.01)).material == "water_calm");
  CHECK(seen_from_above(*scene, local_m(*scene, 52.0, 9.98)).material == "gravel");
}

// All ground became the base material without a word.
TEST_CASE("Land cover that lies elsewhere on the Earth is told", "[ground_geometry]") {
  const TemporaryFolder folder;
  const auto outside = [&](double west_deg) {
    AsciiGrid{30, 40, west_deg, 51.97, 0.002}.write(folder, "cover", [](int, int) { return "1"; });
    const tests::Outcome outcome = tests::build_text(
        folder,
        tests::replaced(standing(), "material = \"short_grass\"",
                        "land_cover = { file = \"cover.asc\", classes = { 1 = \"forest\" } }"));
    REQUIRE(outcome.scene != nullptr);
    return std::count_if(
        outcome.problems.begin(), outcome.problems.end(), [](const core::Problem& problem) {
          return problem.code == "W-OUTSIDE" && problem.field == "terrain.land_cover.file" &&
                 problem.place.line > 0 && problem.value == "cover.asc";
        });
  };
  CHECK(outside(10.0) == 0);
  CHECK(outside(30.0) == 1);
}

TEST_CASE("Runway, shoulder and apron lie on the ground with their materials",
          "[ground_geometry]") {
  const TemporaryFolder folder;
  const std::string text =
      tests::replaced(standing(), "elevation_m = 60.0 }",
                      "elevation_m = 60.0 }\nmarkings = false\nsurface = \"concrete\"\nshoulder = "
                      "\"gravel\"\n[[surface]]\nrunway = \"36\"\nmaterial = \"asphalt_worn\"\n"
                      "behind_threshold_m = [100.0, 300.0]\nleft_m = [60.0, 90.0]");
  const std::unique_ptr<Scene> scene = tests::good_scene(folder, text);
  // Half the width is 22.5 m, the shoulder 7.5 m more.
  for (const auto& [x_m, material] :
       std::vector<std::pair<double, std::string>>{{0, "concrete"},
                                                   {22, "concrete"},
                                                   {-22, "concrete"},
                                                   {23, "gravel"},
                                                   {-29, "gravel"},
                                                   {31, "short_grass"}}) {
    const Seen seen = seen_from_above(*scene, {x_m, 200.0});
    CHECK(seen.material == material);
    CHECK(seen.up_m == Approx(ground_m(*scene, {x_m, 200.0})).epsilon(0.0).margin(0.02));
  }
  // 60 to 90 m left of the landing direction north is west.
  CHECK(seen_from_above(*scene, {-61.0, 101.0}).material == "asphalt_worn");
  CHECK(seen_from_above(*scene, {-89.0, 299.0}).material == "asphalt_worn");
  CHECK(seen_from_above(*scene, {-59.0, 200.0}).material == "short_grass");
  CHECK(seen_from_above(*scene, {-75.0, 301.0}).material == "short_grass");
  CHECK(seen_from_above(*scene, {75.0, 200.0}).material == "short_grass");
}
