#include "terrain/buildings/solid_prisms.h"

#include <catch2/catch.hpp>
#include <vector>

#include "core/errors.h"

namespace fanbeam::terrain {
namespace {

constexpr MaterialId kBrick = 3;
constexpr MaterialId kTar = 5;

Prism block(glm::dvec2 low, glm::dvec2 high, double bottom_m, double top_m, bool on_ground) {
  return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}, bottom_m, top_m, on_ground};
}

// 40 m x 20 m, 10 m high.
Prism hall() { return block({0, 0}, {40, 20}, -2.0, 10.0, true); }
Prism raised(glm::dvec2 low, glm::dvec2 high, double bottom_m, double top_m) {
  return block(low, high, bottom_m, top_m, false);
}

struct Sorted {
  Solids solids;
  std::size_t floating = 0;
};

Sorted sorted(const std::vector<Prism>& prisms) {
  core::ProblemList problems;
  const Extrusion extrusion = extrude(prisms, "town", {}, problems);
  CHECK(problems.all().empty());
  Sorted result;
  result.floating = add_solids(prisms, extrusion, kBrick, kTar, {}, result.solids);
  CHECK(result.solids.others.size() == result.floating);
  return result;
}

}  // namespace

TEST_CASE("A prism on the ground is a solid with its rings, top and materials", "[solid_prisms]") {
  Prism with_yard = hall();
  with_yard.holes_m = {{{10, 5}, {20, 5}, {20, 10}, {10, 10}}};
  const Sorted result = sorted({with_yard});
  REQUIRE(result.solids.prisms.size() == 1);
  const Solid& solid = result.solids.prisms.front();
  CHECK(solid.top_m == 10.0);
  CHECK(solid.wall == kBrick);
  CHECK(solid.roof == kTar);
  REQUIRE(solid.rings_m.size() == 2);
  CHECK(signed_area_m2(solid.rings_m[0]) == Approx(800.0));
  CHECK(signed_area_m2(solid.rings_m[1]) == Approx(-50.0));
  CHECK(result.floating == 0);
}

TEST_CASE("What stands on a building is solid, what hangs over open ground floats",
          "[solid_prisms]") {
  CHECK(sorted({hall(), raised({5, 5}, {15, 15}, 10.0, 40.0)}).floating == 0);
  CHECK(sorted({hall(), raised({5, 5}, {15, 15}, 4.0, 40.0)}).floating == 0);
  // Named before the hall that carries it.
  CHECK(sorted({raised({5, 5}, {15, 15}, 10.0, 40.0), hall()}).floating == 0);

  const Sorted canopy = sorted({hall(), raised({50, 5}, {60, 8}, 4.0, 5.0)});
  REQUIRE(canopy.floating == 1);
  CHECK(canopy.solids.prisms.size() == 1);
  CHECK(canopy.solids.others.front().low == glm::dvec3(50, 5, 4));
  CHECK(canopy.solids.others.front().high == glm::dvec3(60, 8, 5));
}

TEST_CASE("A gap of a centimetre and a hundredth of the footprint are no open air",
          "[solid_prisms]") {
  CHECK(sorted({hall(), raised({5, 5}, {15, 15}, 10.009, 40.0)}).floating == 0);
  CHECK(sorted({hall(), raised({5, 5}, {15, 15}, 10.011, 40.0)}).floating == 1);
  // 10 m wide, the hall ends at 40 m: 0.09 m and 0.11 m stick out.
  CHECK(sorted({hall(), raised({30.09, 5}, {40.09, 15}, 10.0, 40.0)}).floating == 0);
  CHECK(sorted({hall(), raised({30.11, 5}, {40.11, 15}, 10.0, 40.0)}).floating == 1);
}

TEST_CASE("Several buildings carry together, and storeys carry storeys", "[solid_prisms]") {
  const Prism second = block({40, 0}, {60, 20}, -2.0, 12.0, true);
  const Prism bridge = raised({30, 5}, {50, 15}, 10.0, 14.0);
  CHECK(sorted({hall(), bridge}).floating == 1);
  CHECK(sorted({hall(), bridge, second}).floating == 0);
  CHECK(sorted({raised({2, 2}, {6, 6}, 30.0, 50.0), raised({0, 0}, {10, 10}, 10.0, 30.0), hall()})
            .floating == 0);
  // A stack over open ground carries nothing.
  CHECK(
      sorted({raised({52, 2}, {56, 6}, 30.0, 50.0), raised({50, 0}, {60, 10}, 10.0, 30.0), hall()})
          .floating == 2);
}

TEST_CASE("A courtyard carries nothing", "[solid_prisms]") {
  Prism with_yard = hall();
  with_yard.holes_m = {{{10, 5}, {20, 5}, {20, 15}, {10, 15}}};
  CHECK(sorted({with_yard, raised({11, 6}, {19, 14}, 10.0, 40.0)}).floating == 1);
  CHECK(sorted({with_yard, raised({22, 6}, {30, 14}, 10.0, 40.0)}).floating == 0);
}

TEST_CASE("Each part of a repaired prism is judged by itself", "[solid_prisms]") {
  // A bow tie of which the western triangle lies over the hall.
  const Prism bow_tie{{{30, 0}, {50, 20}, {50, 0}, {30, 20}}, {}, 10.0, 20.0, false};
  const Sorted result = sorted({hall(), bow_tie});
  CHECK(result.solids.prisms.size() == 2);
  CHECK(result.floating == 1);
}

TEST_CASE("The box around a mesh holds all its vertices", "[solid_prisms]") {
  TriangleMesh mesh;
  mesh.vertices_m = {{3, -1, 8}, {-2, 4, 5}, {0, 0, 6}};
  CHECK(box_around(mesh).low == glm::dvec3(-2, -1, 5));
  CHECK(box_around(mesh).high == glm::dvec3(3, 4, 8));
}

}  // namespace fanbeam::terrain
