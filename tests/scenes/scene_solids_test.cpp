// One building model feeds both casters: a built scene's solids are what its rays hit.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "terrain/buildings/clean_footprint.h"
#include "terrain/buildings/footprints.h"
#include "tests/scenes/built_scene.h"
#include "tests/scenes/shipped_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using scenes::Scene;
using terrain::Box_m;
using terrain::Ring_m;
using terrain::Solid;
using terrain::Solids;
using tests::shipped_scene;
using tests::TemporaryFolder;

namespace {

double area_m2(const std::vector<Ring_m>& rings) {
  double sum_m2 = 0.0;
  for (const Ring_m& ring : rings) sum_m2 += terrain::signed_area_m2(ring);
  return sum_m2;
}

struct Spot {
  bool inside = false;
  double to_edge_m = 1e300;
};

// By the parity of the edges east of the point.
Spot spot_in(const Solid& solid, const glm::dvec2& point) {
  Spot spot;
  for (const Ring_m& ring : solid.rings_m)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2& a = ring[i];
      const glm::dvec2 along = ring[(i + 1) % ring.size()] - a;
      const glm::dvec2 from_a = point - a;
      const double t = std::clamp(glm::dot(from_a, along) / glm::dot(along, along), 0.0, 1.0);
      spot.to_edge_m = std::min(spot.to_edge_m, glm::length(from_a - t * along));
      const bool crosses = (a.y > point.y) != (a.y + along.y > point.y);
      if (crosses && from_a.y / along.y * along.x > from_a.x) spot.inside = !spot.inside;
    }
  return spot;
}

// East and north of a place on the ground, whose height moves them a little.
glm::dvec2 local_on_ground_m(const Scene& scene, const terrain::GeodeticPoint& point) {
  double height_m = scene.frame.origin().height_m;
  glm::dvec3 local_m{0.0};
  for (int i = 0; i < 3; ++i) {
    local_m = scene.frame.to_local_m({point.latitude_rad, point.longitude_rad, height_m});
    local_m.z =
        scene.world.surfaces().terrain()->height_at(local_m.x, local_m.y).value_or(local_m.z);
    height_m = scene.frame.to_geodetic(local_m).height_m;
  }
  return local_m;
}

bool is_over(const Box_m& box, const glm::dvec2& point) {
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y &&
         point.y <= box.high.y;
}

// Nothing where an edge is too near, or something that is no solid may be met first.
std::optional<double> top_of_solids_m(const Scene& scene, const glm::dvec2& point) {
  const Solids& solids = scene.world.solids();
  double top_m = tests::ground_m(scene, point);
  for (const Solid& solid : solids.prisms) {
    const Spot spot = spot_in(solid, point);
    if (spot.to_edge_m < 0.02) return std::nullopt;
    if (spot.inside) top_m = std::max(top_m, solid.top_m);
  }
  for (const Box_m& other : solids.others)
    if (is_over(other, point)) return std::nullopt;
  return top_m;
}

// Along lines across the place, 7.3 m between rays.
void check_rays_from_above(const Scene& scene, const glm::dvec2& middle_m, double half_m,
                           int at_least_on_roofs) {
  int on_roofs = 0;
  for (double x = -half_m; x < half_m; x += 7.3)
    for (double y = -half_m; y < half_m; y += half_m / 4.0) {
      const glm::dvec2 point = middle_m + glm::dvec2(x, y);
      const auto top_m = top_of_solids_m(scene, point);
      if (!top_m) continue;
      const double seen_m = tests::seen_from_above(scene, point).up_m;
      INFO(point.x << " m east, " << point.y << " m north");
      REQUIRE(seen_m == Approx(*top_m).epsilon(0.0).margin(0.01));
      if (*top_m > tests::ground_m(scene, point)) ++on_roofs;
    }
  CHECK(on_roofs >= at_least_on_roofs);
}

}  // namespace

TEST_CASE("A box is a solid with its top and materials, and no ray disagrees", "[scene_solids]") {
  const TemporaryFolder folder;
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(tests::standing(), "height_m = 12.0",
                              "height_m = 12.0\nheading_deg = 30.0\nwall = \"brick\""));
  REQUIRE(scene->world.solids().prisms.size() == 1);
  CHECK(scene->world.solids().others.empty());
  const Solid& hangar = scene->world.solids().prisms.front();
  CHECK(area_m2(hangar.rings_m) == Approx(40.0 * 30.0).epsilon(1e-9));
  CHECK(hangar.top_m ==
        Approx(tests::ground_m(*scene, {-200.0, 300.0}) + 12.0).epsilon(0.0).margin(1e-3));
  CHECK(scene->world.geometry->material_names.at(hangar.wall) == "brick");
  CHECK(scene->world.geometry->material_names.at(hangar.roof) == "roof");
  check_rays_from_above(*scene, {-200.0, 300.0}, 30.0, 15);
}

TEST_CASE("A storey over a hall is a solid, a canopy is a box and is counted", "[scene_solids]") {
  const TemporaryFolder folder;
  const auto feature = [](const char* heights, double west_deg) {
    const auto at = [west_deg](int east, int north) {
      return std::string("[") + core::number_text(west_deg + 0.0003 * east) + "," +
             core::number_text(52.01 + 0.0002 * north) + "]";
    };
    return std::string(R"({"type":"Feature","properties":{)") + heights +
           R"(},"geometry":{"type":"Polygon","coordinates":[[)" + at(0, 0) + "," + at(1, 0) + "," +
           at(1, 1) + "," + at(0, 1) + "," + at(0, 0) + "]]}}";
  };
  folder.write("town.geojson", R"({"type":"FeatureCollection","features":[)" +
                                   feature(R"("render_height":30,"render_min_height":9)", 10.01) +
                                   "," + feature(R"("render_height":9)", 10.01) + "," +
                                   feature(R"("render_height":6,"render_min_height":5)", 10.02) +
                                   "]}");
  const std::unique_ptr<Scene> scene = tests::good_scene(
      folder, tests::replaced(tests::standing(), "[weather]",
                              "[[buildings]]\nfile = \"town.geojson\"\n[weather]"));
  const Solids& solids = scene->world.solids();
  CHECK(solids.prisms.size() == 3);  // with the hangar
  REQUIRE(solids.others.size() == 1);
  CHECK(scene->raised_buildings == 2);
  CHECK(scene->floating_buildings == 1);
  const Box_m& canopy = solids.others.front();
  const glm::dvec2 middle_m = tests::local_m(*scene, 52.0101, 10.02015);
  CHECK(is_over(canopy, middle_m));
  CHECK(canopy.low.z == Approx(tests::ground_m(*scene, middle_m) + 5.0).epsilon(0.0).margin(0.1));
  CHECK(canopy.high.z == Approx(canopy.low.z + 1.0).epsilon(0.0).margin(1e-9));
  CHECK(tests::seen_from_above(*scene, middle_m).up_m ==
        Approx(canopy.high.z).epsilon(0.0).margin(0.01));
}

TEST_CASE("Braunschweig's truck is a box around it, its buildings are solids", "[scene_solids]") {
  const std::unique_ptr<Scene> scene = shipped_scene("braunschweig-26");
  REQUIRE(scene->world.solids().others.size() == 1);
  CHECK(scene->floating_buildings == 0);
  const Box_m& truck = scene->world.solids().others.front();
  CHECK(truck.high.z - truck.low.z > 2.0);
  CHECK(truck.high.z - truck.low.z < 5.0);
  CHECK(glm::length(glm::dvec2(truck.high) - glm::dvec2(truck.low)) < 25.0);
  const glm::dvec2 middle_m = 0.5 * (glm::dvec2(truck.low) + glm::dvec2(truck.high));
  CHECK(tests::seen_from_above(*scene, middle_m).material == "metal");
  CHECK(scene->world.solids().prisms.size() > 100);
}

TEST_CASE("Innsbruck's solids are its footprints, less the parts over open air",
          "[scene_solids][data]") {
  const auto data = tests::shared_data("lowi-innsbruck");
  if (!data) return;
  const std::unique_ptr<Scene> scene = shipped_scene("innsbruck-26", {data->parent_path()});
  const Solids& solids = scene->world.solids();
  // 59 features of the file are raised. 55 lie on the terrain; 22 of them stand on others.
  CHECK(scene->raised_buildings == 55);
  CHECK(scene->floating_buildings == 33);
  CHECK(solids.others.size() == 33);
  core::ProblemList problems;
  double all_m2 = 0.0, floating_m2 = 0.0;
  std::size_t polygons = 0, raised = 0;
  const auto is_floating = [&](const glm::dvec2& low, const glm::dvec2& high, double height_m) {
    return std::any_of(solids.others.begin(), solids.others.end(), [&](const Box_m& box) {
      return glm::distance(glm::dvec2(box.low), low) < 1e-6 &&
             glm::distance(glm::dvec2(box.high), high) < 1e-6 &&
             std::abs(box.high.z - box.low.z - height_m) < 1e-9;
    });
  };
  for (const terrain::Footprint& footprint :
       terrain::read_footprints(scene->description.buildings.at(0).file, {}, problems)) {
    std::vector<terrain::GeodeticRing> geodetic = footprint.holes;
    geodetic.insert(geodetic.begin(), footprint.outer);
    std::vector<Ring_m> rings;
    for (const terrain::GeodeticRing& ring : geodetic) {
      rings.emplace_back();
      for (const terrain::GeodeticPoint& point : ring)
        rings.back().push_back(local_on_ground_m(*scene, point));
    }
    glm::dvec2 low = rings[0][0], high = rings[0][0];
    bool on_terrain = true;
    for (const glm::dvec2& point : rings[0]) {
      low = glm::min(low, point);
      high = glm::max(high, point);
      on_terrain =
          on_terrain && scene->world.surfaces().terrain()->height_at(point.x, point.y).has_value();
    }
    if (!on_terrain) continue;
    ++polygons;
    all_m2 += area_m2(rings);
    if (!(footprint.min_height_m > 0.0)) continue;
    ++raised;
    if (is_floating(low, high, footprint.height_m - footprint.min_height_m))
      floating_m2 += area_m2(rings);
  }
  double solid_m2 = 0.0;
  for (const Solid& solid : solids.prisms) solid_m2 += area_m2(solid.rings_m);
  CHECK(raised == 55);
  CHECK(solids.prisms.size() + solids.others.size() == polygons);
  CHECK(floating_m2 > 5000.0);
  CHECK(solid_m2 == Approx(all_m2 - floating_m2).epsilon(1e-9));
  check_rays_from_above(*scene, {3000.0, 300.0}, 400.0, 100);
}
