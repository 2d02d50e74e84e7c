#include "terrain/buildings/extrusion.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "terrain/buildings/footprints.h"
#include "terrain/local_frame.h"
#include "tests/shared_data.h"

namespace fanbeam::terrain {
namespace {

using Catch::Matchers::Contains;

// Volume over the plane z = `bottom_m` by the divergence theorem: the missing floor adds nothing.
double volume_m3(const TriangleMesh& mesh, double bottom_m) {
  double six_volumes_m3 = 0.0;
  const glm::dvec3 base_m =
      mesh.vertices_m.front() * glm::dvec3(1.0, 1.0, 0.0) + glm::dvec3(0.0, 0.0, bottom_m);
  for (const glm::uvec3& triangle : mesh.triangles)
    six_volumes_m3 += glm::dot(
        mesh.vertices_m[triangle.x] - base_m,
        glm::cross(mesh.vertices_m[triangle.y] - base_m, mesh.vertices_m[triangle.z] - base_m));
  return six_volumes_m3 / 6.0;
}

double area_m2(const TriangleMesh& mesh, std::uint32_t slot) {
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_material[i] != slot) continue;
    const glm::uvec3& t = mesh.triangles[i];
    sum_m2 += 0.5 * glm::length(glm::cross(mesh.vertices_m[t.y] - mesh.vertices_m[t.x],
                                           mesh.vertices_m[t.z] - mesh.vertices_m[t.x]));
  }
  return sum_m2;
}

// Edges by position that have no partner of the opposite direction, above `bottom_m`.
int open_edges_above(const TriangleMesh& mesh, double bottom_m) {
  using Point = std::vector<double>;
  std::map<std::pair<Point, Point>, int> balance;
  const auto point = [&mesh](std::uint32_t index) {
    const glm::dvec3& v = mesh.vertices_m[index];
    return Point{v.x, v.y, v.z};
  };
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Point a = point(t[k]);
      const Point b = point(t[(k + 1) % 3]);
      if (a[2] == bottom_m && b[2] == bottom_m) continue;
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  return static_cast<int>(
      std::count_if(balance.begin(), balance.end(), [](const auto& e) { return e.second != 0; }));
}

// Both casters see the same building: its polygons have the roofs' area, and an edge of a ring
// is the bottom of a wall and the other way round.
void check_polygons_are_the_mesh(const Extrusion& extrusion) {
  using Edge = std::array<double, 4>;
  std::multiset<Edge> ring_edges;
  double sum_m2 = 0.0;
  for (const ExtrudedPolygon& polygon : extrusion.polygons)
    for (const Ring_m& ring : polygon.rings_m) {
      sum_m2 += signed_area_m2(ring);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2& a = ring[i];
        const glm::dvec2& b = ring[(i + 1) % ring.size()];
        ring_edges.insert({a.x, a.y, b.x, b.y});
      }
    }
  std::multiset<Edge> wall_edges;
  const TriangleMesh& mesh = extrusion.mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_material[i] != kWallSlot) continue;
    const glm::uvec3& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& a = mesh.vertices_m[t[k]];
      const glm::dvec3& b = mesh.vertices_m[t[(k + 1) % 3]];
      const bool upright = a.x == b.x && a.y == b.y;
      if (a.z == b.z && !upright && a.z < mesh.vertices_m[t[(k + 2) % 3]].z)
        wall_edges.insert({a.x, a.y, b.x, b.y});
    }
  }
  CHECK(sum_m2 == Approx(area_m2(mesh, kRoofSlot)).epsilon(1e-9));
  CHECK(ring_edges.size() == wall_edges.size());
  CHECK((ring_edges == wall_edges));
}

Extrusion extrude_one(const Prism& prism) {
  core::ProblemList problems;
  Extrusion result = extrude({prism}, "buildings", {}, problems);
  CHECK(problems.all().empty());
  check_polygons_are_the_mesh(result);
  return result;
}

Prism with_courtyard() {
  // 40 m x 30 m with a courtyard of 10 m x 8 m, away from the origin; rings in the wrong direction.
  const auto at = [](double x, double y) { return glm::dvec2(4000.0 + x, -2500.0 + y); };
  return {{at(0, 0), at(0, 30), at(40, 30), at(40, 0)},
          {{at(12, 9), at(22, 9), at(22, 17), at(12, 17)}},
          581.0,
          596.5};
}

}  // namespace

TEST_CASE("A prism with a courtyard has the volume of its area times its height", "[extrusion]") {
  const Extrusion extrusion = extrude_one(with_courtyard());
  const double expected_area_m2 = 40.0 * 30.0 - 10.0 * 8.0;
  CHECK(volume_m3(extrusion.mesh, 581.0) == Approx(expected_area_m2 * 15.5).epsilon(1e-9));
  CHECK(area_m2(extrusion.mesh, kRoofSlot) == Approx(expected_area_m2).epsilon(1e-12));
  CHECK(area_m2(extrusion.mesh, kWallSlot) == Approx((140.0 + 36.0) * 15.5).epsilon(1e-12));
  CHECK(open_edges_above(extrusion.mesh, 581.0) == 0);
  CHECK(extrusion.failed == 0);
}

TEST_CASE("Walls face away from the building, into its courtyard too, and roofs up",
          "[extrusion]") {
  const Extrusion extrusion = extrude_one(with_courtyard());
  const TriangleMesh& mesh = extrusion.mesh;
  CHECK(mesh.material_names == std::vector<std::string>{"wall", "roof"});
  const auto inside_building = [](const glm::dvec3& p) {
    const double x = p.x - 4000.0;
    const double y = p.y + 2500.0;
    const bool in_courtyard = x > 12.0 && x < 22.0 && y > 9.0 && y < 17.0;
    return x > 0.0 && x < 40.0 && y > 0.0 && y < 30.0 && !in_courtyard;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::dvec3& a = mesh.vertices_m[mesh.triangles[i].x];
    const glm::dvec3& b = mesh.vertices_m[mesh.triangles[i].y];
    const glm::dvec3& c = mesh.vertices_m[mesh.triangles[i].z];
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const glm::dvec3 middle_m = (a + b + c) / 3.0;
    if (mesh.triangle_material[i] == kRoofSlot) {
      CHECK(normal.z == Approx(1.0));
      CHECK(inside_building(middle_m));
    } else {
      CHECK(std::abs(normal.z) < 1e-12);
      CHECK_FALSE(inside_building(middle_m + 0.01 * normal));
      CHECK(inside_building(middle_m - 0.01 * normal));
    }
  }
}

TEST_CASE("A ring that touches itself is extruded with the area it encloses", "[extrusion]") {
  // The outline runs through (0, 0) twice, cutting a triangle of 2 m x 2 m out of a 10 m square.
  const Prism pinched{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {2, 4}, {4, 4}}, {}, 0.0, 6.0};
  const Extrusion touching = extrude_one(pinched);
  CHECK(volume_m3(touching.mesh, 0.0) == Approx((100.0 - 4.0) * 6.0).epsilon(1e-9));
  CHECK(open_edges_above(touching.mesh, 0.0) == 0);

  const Prism bow_tie{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}, 0.0, 3.0};
  const Extrusion crossing = extrude_one(bow_tie);
  CHECK(volume_m3(crossing.mesh, 0.0) == Approx(8.0 * 3.0).epsilon(1e-9));

  REQUIRE(crossing.polygons.size() == 2);
  CHECK(crossing.polygons[1].prism == 0);

  // Courtyards that touch a corner of the outline and one another.
  const Prism yards{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                    {{{0, 0}, {4, 2}, {2, 4}}, {{4, 2}, {8, 3}, {8, 7}}},
                    0.0,
                    5.0};
  CHECK(volume_m3(extrude_one(yards).mesh, 0.0) == Approx((100.0 - 6.0 - 8.0) * 5.0).epsilon(1e-9));

  // A repeated point and one on a straight edge are no reason to fail.
  const Prism repeated{{{0, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}}, {}, 0.0, 1.0};
  CHECK(volume_m3(extrude_one(repeated).mesh, 0.0) == Approx(100.0).epsilon(1e-9));
}

TEST_CASE("Every triangle names its prism, and prisms that fail leave nothing", "[extrusion]") {
  const Prism square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}, 0.0, 5.0};
  const Prism line{{{0, 0}, {10, 0}, {20, 0}}, {}, 0.0, 5.0};
  const Prism two_points{{{0, 0}, {10, 0}}, {}, 0.0, 5.0};
  Prism upside_down = square;
  upside_down.top_m = -1.0;
  core::ProblemList problems;
  const Extrusion extrusion =
      extrude({line, square, two_points, upside_down, square}, "city", {"brick", "tar"}, problems);
  CHECK(extrusion.failed == 3);
  CHECK(extrusion.mesh.triangles.size() == 20);
  CHECK(std::count(extrusion.mesh.triangle_part.begin(), extrusion.mesh.triangle_part.end(), 1U) == 10);
  CHECK(std::count(extrusion.mesh.triangle_part.begin(), extrusion.mesh.triangle_part.end(), 4U) == 10);
  REQUIRE(extrusion.polygons.size() == 2);
  CHECK(extrusion.polygons[0].prism == 1);
  CHECK(extrusion.polygons[1].prism == 4);
  CHECK(extrusion.mesh.material_names == std::vector<std::string>{"brick", "tar"});
  REQUIRE(problems.all().size() == 1);
  CHECK_THAT(core::to_string(problems.all().front()),
             Contains("W-DEGENERATE city buildings without area or height = 3"));
}

TEST_CASE("Where a roof cannot be triangulated there is neither mesh nor polygon", "[extrusion]") {
  // GEOS gives up on a courtyard that touches its outline between two corners.
  const Prism square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}, 0.0, 5.0};
  Prism touching_side = square;
  touching_side.holes_m = {{{0, 4}, {3, 3}, {3, 5}}};
  core::ProblemList problems;
  const Extrusion extrusion = extrude({square, touching_side, square}, "city", {}, problems);
  CHECK(extrusion.failed == 1);
  REQUIRE(extrusion.polygons.size() == 2);
  CHECK(extrusion.polygons[1].prism == 2);
  check_polygons_are_the_mesh(extrusion);
  REQUIRE(problems.all().size() == 1);
  CHECK_THAT(core::to_string(problems.all().front()), Contains("W-SKIPPED"));
}

TEST_CASE("Prisms with absurd coordinates are errors by index", "[extrusion]") {
  Prism nan_point{{{0, 0}, {10, 0}, {std::numeric_limits<double>::quiet_NaN(), 10}}, {}, 0.0, 5.0};
  Prism far_away{{{0, 0}, {2e6, 0}, {0, 10}}, {}, 0.0, 5.0};
  core::ProblemList problems;
  const Extrusion extrusion = extrude({nan_point, far_away}, "city", {}, problems);
  CHECK(extrusion.mesh.triangles.empty());
  CHECK(extrusion.polygons.empty());
  REQUIRE(problems.all().size() == 2);
  CHECK_THAT(core::to_string(problems.all()[0]), Contains("E-NONFINITE city building 0"));
  CHECK_THAT(core::to_string(problems.all()[1]), Contains("E-RANGE city building 1"));
}

TEST_CASE("All of Innsbruck's buildings extrude, closed and with the right volume",
          "[extrusion][data]") {
  const auto file = tests::shared_data("lowi-innsbruck/buildings.geojson");
  if (!file) return;
  core::ProblemList problems;
  const auto footprints = read_footprints(*file, {}, problems);
  const LocalFrame frame({core::radians(47.26), core::radians(11.34), 581.0});
  std::vector<Prism> prisms;
  double expected_m2 = 0.0;
  const auto local = [&frame](const GeodeticRing& ring) {
    Ring_m points_m;
    for (const GeodeticPoint& point : ring) {
      const glm::dvec3 local_m = frame.to_local_m({point.latitude_rad, point.longitude_rad, 581.0});
      points_m.emplace_back(local_m.x, local_m.y);
    }
    return points_m;
  };
  const auto twice_area_m2 = [](const Ring_m& ring) {
    double twice_m2 = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i] - ring[0];
      const glm::dvec2 b = ring[(i + 1) % ring.size()] - ring[0];
      twice_m2 += a.x * b.y - a.y * b.x;
    }
    return twice_m2;
  };
  for (const Footprint& footprint : footprints) {
    Prism prism{local(footprint.outer), {}, 0.0, 10.0};
    expected_m2 += 0.5 * twice_area_m2(prism.outer_m);
    for (const GeodeticRing& hole : footprint.holes) {
      prism.holes_m.push_back(local(hole));
      expected_m2 += 0.5 * twice_area_m2(prism.holes_m.back());
    }
    prisms.push_back(std::move(prism));
  }
  const Extrusion extrusion = extrude(prisms, "buildings", {}, problems);
  std::string messages;
  for (const core::Problem& problem : problems.all()) messages += core::to_string(problem) + "\n";
  INFO(messages << extrusion.mesh.triangles.size() << " triangles");
  CHECK(extrusion.failed == 0);
  CHECK(area_m2(extrusion.mesh, kRoofSlot) == Approx(expected_m2).epsilon(1e-9));
  CHECK(volume_m3(extrusion.mesh, 0.0) == Approx(expected_m2 * 10.0).epsilon(1e-8));
  check_polygons_are_the_mesh(extrusion);
}

}  // namespace fanbeam::terrain
