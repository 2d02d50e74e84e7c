// Real rasters in all the formats: the shared data folder's README files state what is checked
// here.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/errors.h"
#include "core/files.h"
#include "core/random.h"
#include "core/units.h"
#include "terrain/raster/elevation_raster.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::terrain {
namespace {

using core::radians;
using tests::shared_data;

double known_height_m(const ElevationRaster& raster, double latitude_deg, double longitude_deg) {
  const auto height_m = raster.height_m(radians(latitude_deg), radians(longitude_deg));
  REQUIRE(height_m);
  return *height_m;
}

}  // namespace

TEST_CASE("An SRTM cell as .hgt and DTED 1 and 0 holds the same heights", "[elevation][data]") {
  const auto folder = shared_data("srtm-n47e009");
  if (!folder) return;
  const std::string bytes = core::read_file(*folder / "N47E009.hgt", 1U << 24U);
  const ElevationRaster hgt(*folder / "N47E009.hgt", {});
  const ElevationRaster dted1(*folder / "n47_e009.dt1", {});
  const ElevationRaster dted0(*folder / "n47_e009.dt0", {});
  REQUIRE(hgt.width() == 1201);
  REQUIRE(dted1.width() == 1201);
  REQUIRE(dted0.width() == 121);
  CHECK(hgt.voids() == 15'299);
  CHECK(dted1.voids() == 15'299);
  CHECK(dted0.voids() == 137);
  CHECK(hgt.holes() == 0);

  int wrong = 0;
  for (int row = 0; row < 1201; ++row) {
    for (int column = 0; column < 1201; ++column) {
      const auto at = static_cast<std::size_t>(2 * (row * 1201 + column));
      const auto high = static_cast<unsigned char>(bytes[at]);
      const auto low = static_cast<unsigned char>(bytes[at + 1]);
      const auto sample = static_cast<std::int16_t>(high << 8 | low);
      if (sample == -32768) continue;
      if (*hgt.post_height_m(column, row) != sample) ++wrong;
      if (*dted1.post_height_m(column, row) != sample) ++wrong;
      if (row % 10 == 0 && column % 10 == 0 &&
          *dted0.post_height_m(column / 10, row / 10) != sample)
        ++wrong;
    }
  }
  CHECK(wrong == 0);
  // Samples are points: the first is at 48 N 9 E, the last at 47 N 10 E.
  for (const ElevationRaster* raster : {&hgt, &dted1, &dted0}) {
    CHECK(known_height_m(*raster, 48.0, 9.0) ==
          Approx(*hgt.post_height_m(0, 0)).epsilon(0.0).margin(1e-6));
    CHECK(known_height_m(*raster, 47.0, 10.0) ==
          Approx(*hgt.post_height_m(1200, 1200)).epsilon(0.0).margin(1e-6));
    CHECK(known_height_m(*raster, 47.5, 9.5) ==
          Approx(*hgt.post_height_m(600, 600)).epsilon(0.0).margin(1e-6));
  }
}

TEST_CASE("Innsbruck's terrain has the published range and agrees with its UTM copy",
          "[elevation][data]") {
  const auto folder = shared_data("lowi-innsbruck");
  if (!folder) return;
  const ElevationRaster wgs84(*folder / "dem_lowi_wgs84_1arcsec.tif", {});
  const ElevationRaster utm(*folder / "dem_lowi_utm32n_25m_float32.tif", {});
  const ElevationRaster core_part(*folder / "dem_lowi_core_1arcsec.asc", {});
  CHECK(wgs84.width() == 1980);
  CHECK(wgs84.height() == 1008);
  CHECK(wgs84.lowest_m() == 528.0);
  CHECK(wgs84.highest_m() == 3003.0);
  // Whole metres at the thresholds 08 and 26 (README of the data).
  CHECK(std::abs(known_height_m(wgs84, 47.2589, 11.3310) - 582.0) < 3.0);
  CHECK(std::abs(known_height_m(wgs84, 47.2617, 11.3571) - 578.0) < 3.0);

  double utm_squares = 0.0;
  double largest_core_m = 0.0;
  constexpr std::uint64_t kPoints = 20'000;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const auto words = core::random_words({3, core::kStreamTerrain, 0}, i, 0);
    // Inside both copies; the core part spans 0.2 deg x 0.08 deg.
    const double latitude_deg = 47.23 + 0.06 * core::uniform_from(words[0]);
    const double longitude_deg = 11.27 + 0.17 * core::uniform_from(words[1]);
    const double wgs84_m = known_height_m(wgs84, latitude_deg, longitude_deg);
    utm_squares += std::pow(known_height_m(utm, latitude_deg, longitude_deg) - wgs84_m, 2);
    const auto core_m = core_part.height_m(radians(latitude_deg), radians(longitude_deg));
    if (core_m) largest_core_m = std::max(largest_core_m, std::abs(*core_m - wgs84_m));
  }
  const double utm_rms_m = std::sqrt(utm_squares / static_cast<double>(kPoints));
  INFO("UTM copy differs by " << utm_rms_m << " m RMS");
  // Both were averaged from finer cells, each to its own grid; half a pixel of shift would give 6
  // m.
  CHECK(utm_rms_m < 2.0);
  // The ASCII grid rounds its cell size to 1e-12 deg: 1e-6 posts over its width.
  CHECK(largest_core_m < 1e-4);
}

TEST_CASE("Keflavik's posts lie where its description puts them", "[elevation][data]") {
  const auto file = shared_data("bikf-keflavik/dem_bikf_50m.tif");
  if (!file) return;
  const ElevationRaster raster(*file, {});
  REQUIRE(raster.width() == 401);
  REQUIRE(raster.height() == 401);
  CHECK(raster.lowest_m() == Approx(-4.6).epsilon(0.0).margin(0.05));
  CHECK(raster.highest_m() == Approx(138.7).epsilon(0.0).margin(0.05));
  double largest_m = 0.0;
  for (int row = 1; row < 400; row += 3)
    for (int column = 1; column < 400; column += 3)
      largest_m =
          std::max(largest_m, std::abs(known_height_m(raster, 64.0747046 - 0.000448523 * row,
                                                      -22.8092568 + 0.001021284 * column) -
                                       *raster.post_height_m(column, row)));
  INFO("largest difference " << largest_m << " m");
  // The description rounds the spacing: 4e-4 posts at the far end, on slopes up to 60 m per post.
  CHECK(largest_m < 0.05);
}

TEST_CASE("Truncated copies of real rasters are refused, never read as zeros",
          "[elevation][data]") {
  const auto root = shared_data("lowi-innsbruck");
  if (!root) return;
  const tests::TemporaryFolder folder;
  const auto check = [&](const std::filesystem::path& original) {
    const std::string whole = core::read_file(original, 1U << 24U);
    for (const double part : {0.01, 0.25, 0.5, 0.9, 0.999}) {
      const auto length = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      const auto file = folder.write(original.filename().string(), whole.substr(0, length));
      CAPTURE(file.string(), part);
      CHECK_THROWS_WITH(ElevationRaster(file, {}), Catch::Matchers::Contains("E-PARSE"));
    }
  };
  folder.write("dem_lowi_core_1arcsec.prj",
               core::read_file(*root / "dem_lowi_core_1arcsec.prj", 1U << 24U));
  check(*root / "dem_lowi_core_1arcsec.asc");
  check(*root / "dem_lowi_wgs84_1arcsec.tif");
  check(*root / "dem_lowi_utm32n_25m_float32.tif");
  const auto srtm = shared_data("srtm-n47e009");
  if (!srtm) return;
  check(*srtm / "N47E009.hgt");
  check(*srtm / "n47_e009.dt1");
  check(*srtm / "n47_e009.dt0");
}

}  // namespace fanbeam::terrain
