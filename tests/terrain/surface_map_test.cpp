// What lies on the ground: patches of any shape, whatever cells they cross.
#include "terrain/surface_map.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "terrain/polygon.h"

namespace fanbeam::terrain {
namespace {

// 120 x 80 cells of 2.5 m.
HeightField plain() { return make_height_field(-150.0, -100.0, 150.0, 100.0, 2.5); }

std::vector<SurfacePatch> painted() {
  std::vector<SurfacePatch> patches;
  for (int i = 0; i < 12; ++i) {
    const double turn_rad = core::kPi * i / 12.0;
    patches.push_back(rectangle_patch({7.0 * i - 40.0, 30.0 - 5.0 * i},
                                      {std::sin(turn_rad), std::cos(turn_rad)}, 30.0 + 40.0 * i,
                                      0.7 + i, static_cast<MaterialId>(i + 1)));
  }
  // A U that is open to the north, along the cells' borders, and a needle over the edge of the ground.
  patches.push_back({{{-50.0, -50.0},
                      {50.0, -50.0},
                      {50.0, 50.0},
                      {40.0, 50.0},
                      {40.0, -40.0},
                      {-40.0, -40.0},
                      {-40.0, 50.0},
                      {-50.0, 50.0}},
                     20});
  patches.push_back({{{100.0, 0.0}, {400.0, 1.0}, {100.0, 2.0}}, 21});
  return patches;
}

TEST_CASE("The patch on top of a place is the last one around it", "[surface_map]") {
  const HeightField field = plain();
  const std::vector<SurfacePatch> patches = painted();
  const SurfaceMap map(field, patches);
  std::size_t covered = 0;
  for (double x_m = -149.9; x_m < 150.0; x_m += 0.83)
    for (double y_m = -99.9; y_m < 100.0; y_m += 0.61) {
      MaterialId expected = 0;
      for (const SurfacePatch& patch : patches)
        if (crosses_odd(patch.outline_m, x_m, y_m)) expected = patch.material;
      covered += expected != 0 ? 1 : 0;
      if (map.material_at(x_m, y_m) != expected) FAIL_CHECK("at " << x_m << ", " << y_m);
    }
  CHECK(covered > 10'000);
}

TEST_CASE("A narrow patch across the ground is remembered by few cells", "[surface_map]") {
  const HeightField field = plain();
  const SurfacePatch narrow = rectangle_patch({0.0, 0.0}, {0.6, 0.8}, 200.0, 1.0, 1);
  // 64 rows of 2.5 m, in each 1.9 m along and 1.25 m across.
  CHECK(cells_under(narrow, field) < 4 * 66);
  CHECK(cells_under(narrow, field) >= 64);
  CHECK(cells_under(rectangle_patch({0.0, 0.0}, {0.0, 1.0}, 1e4, 1e4, 1), field) == 120 * 80);
  CHECK(cells_under({{}, 1}, field) == 0);
}

TEST_CASE("R17 patches over too many cells are E-LIMIT", "[surface_map][R17]") {
  const HeightField field = plain();
  const std::size_t most = kMostPatchedCells / (120 * 80);
  std::vector<SurfacePatch> patches(most, rectangle_patch({0.0, 0.0}, {0.0, 1.0}, 1e4, 1e4, 1));
  patches.push_back(patches.back());
  CHECK_THROWS_WITH(SurfaceMap(field, patches), Catch::Matchers::Contains("E-LIMIT"));
}

}  // namespace
}  // namespace fanbeam::terrain
