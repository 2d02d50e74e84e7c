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

// Two triangles 990 km apart took 4 GB, one that nothing hangs on as much.
TEST_CASE("Squares grow where meshes lie far apart or triangles are large, and bound them still",
          "[mesh_tops]") {
  TriangleMesh far;
  far.vertices_m = {{0, 0, 5},
                    {10, 0, 5},
                    {0, 10, 6},
                    {990e3, 990e3, 1},
                    {990e3 - 9, 990e3, 2},
                    {990e3, 990e3 - 9, 3}};
  far.triangles = {{0, 1, 2}, {3, 4, 5}};
  const MeshTops tops({&far});
  CHECK(tops.spacing_m() == 256.0);  // (990 008 / 256 + 1)^2 = 1.50e7; 5.98e7 of 128 m
  CHECK(tops.top_m(1.0, 1.0) == 6.0);
  CHECK(tops.top_m(990e3 - 1.0, 990e3 - 1.0) == 3.0);
  CHECK(tops.top_m(500e3, 500e3) == MeshTops::kNothing_m);

  far.triangles = {{0, 1, 2}};
  CHECK(MeshTops({&far}).spacing_m() == MeshTops::kSpacing_m);

  // A thousand sheets of 100 km: (100 008 / 128 + 1)^2 = 6.12e5 squares of 128 m under each, 1.53e5 of 256 m;
  // 5.37e5 are the most.
  TriangleMesh wide;
  wide.vertices_m = {{0, 0, 5}, {100e3, 0, 5}, {0, 100e3, 7}};
  wide.triangles.assign(1000, {0, 1, 2});
  const MeshTops sheets({&wide});
  CHECK(sheets.spacing_m() == 256.0);
  CHECK(sheets.top_m(50e3, 1.0) == 7.0);
}

}  // namespace
}  // namespace fanbeam::terrain
