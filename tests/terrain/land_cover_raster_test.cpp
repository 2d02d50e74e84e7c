#include "terrain/raster/land_cover_raster.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::terrain {
namespace {

using core::radians;
using tests::AsciiGrid;

int class_deg(const LandCoverRaster& raster, double latitude_deg, double longitude_deg) {
  return raster.class_at(radians(latitude_deg), radians(longitude_deg));
}

}  // namespace

TEST_CASE("A class holds over its whole pixel and is never mixed with its neighbour",
          "[land_cover]") {
  const tests::TemporaryFolder folder;
  const AsciiGrid grid{6, 4, 11.0, 47.0, 0.01};
  const auto class_of = [](int column, int row) { return (column * 7 + row * 3) % 12; };
  const auto file = grid.write(folder, "cover", [&](int column, int row) {
    return column == 5 && row == 0 ? "-9999" : std::to_string(class_of(column, row));
  });
  const LandCoverRaster raster(file);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 5; ++column)
      for (const double offset_deg : {-0.00499, 0.0, 0.00499})
        CHECK(class_deg(raster, grid.post_y(row) + offset_deg, grid.post_x(column) - offset_deg) ==
              class_of(column, row));
  CHECK(class_deg(raster, grid.post_y(0), grid.post_x(5)) == kNoLandCover);
  CHECK(class_deg(raster, 47.02, 10.9999) == kNoLandCover);
  CHECK(class_deg(raster, 47.0401, 11.02) == kNoLandCover);
  CHECK(raster.classes() == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
}

TEST_CASE("Land cover that is no class number is refused", "[land_cover]") {
  const tests::TemporaryFolder folder;
  const AsciiGrid grid{2, 2, 11.0, 47.0, 0.01};
  for (const std::string value : {"2.5", "-3", "65536"}) {
    const auto file = grid.write(folder, "odd", [&](int, int) { return value; });
    CHECK_THROWS_WITH(LandCoverRaster(file),
                      Catch::Matchers::Contains("E-RANGE land cover class = " + value));
  }
}

TEST_CASE("Innsbruck's land cover shows runway, river and grass", "[land_cover][data]") {
  const auto file = tests::shared_data("lowi-innsbruck/landcover_lowi_utm32n_10m.tif");
  if (!file) return;
  const LandCoverRaster raster(*file);
  CHECK(raster.width() == 1600);
  CHECK(raster.height() == 950);
  CHECK(raster.classes().back() == 11);
  // Half way between the thresholds.
  CHECK(class_deg(raster, 47.2603, 11.3440) == 10);
  CHECK(class_deg(raster, 46.0, 11.3) == kNoLandCover);
}

}  // namespace fanbeam::terrain
