// The bound of heights that guides the elevation fan.
#include "terrain/mesh_tops.h"

#include <catch2/catch.hpp>

namespace fanbeam::terrain {
namespace {

TEST_CASE("Tops bound every mesh over its squares, and are nothing beside them", "[mesh_tops]") {
  TriangleMesh low, high;
  low.vertices_m = {{0, 0, 5}, {100, 0, 5}, {0, 100, 6}};
  low.triangles = {{0, 1, 2}};
  high.vertices_m = {{200, 10, 0}, {210, 10, 40}, {205, 20, 0}};
  high.triangles = {{0, 1, 2}};
  const MeshTops tops({&low, &high});
  CHECK(tops.top_m(1.0, 1.0) == 6.0);
  CHECK(tops.top_m(99.0, 1.0) == 6.0);
  CHECK(tops.top_m(205.0, 12.0) == 40.0);
  CHECK(tops.top_m(150.0, 1.0) == MeshTops::kNothing_m);  // between them
  CHECK(tops.top_m(205.0, 99.0) == MeshTops::kNothing_m);
  // A lone corner is found from any of the points a quarter of a square apart that look for it.
  for (const double away_m : {1.0, 3.9}) {
    CHECK(tops.top_m(-away_m, 1.0) == 6.0);
    CHECK(tops.top_m(210.0 + away_m, 20.0 + away_m) == 40.0);
    CHECK(tops.top_m(200.0 - away_m, 10.0 - away_m) == 40.0);
  }
  CHECK(tops.top_m(-5.0, 1.0) == MeshTops::kNothing_m);
  CHECK(tops.top_m(1.0, 1000.0) == MeshTops::kNothing_m);
  CHECK(MeshTops().top_m(0.0, 0.0) == MeshTops::kNothing_m);
}

}  // namespace
}  // namespace fanbeam::terrain
