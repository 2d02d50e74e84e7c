#include "terrain/raster/elevation_raster.h"

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "tests/terrain/ascii_grid.h"
#include "tests/terrain/refused_raster.h"

namespace fanbeam::terrain {
namespace {

using Catch::Matchers::Contains;
using core::radians;
using tests::AsciiGrid;
using tests::refusal_of_raster;
using tests::TemporaryFolder;

ElevationRaster load(const std::filesystem::path& file, const ElevationOptions& options = {}) {
  return {file, options};
}

ElevationRaster load_as(const std::filesystem::path& file, Interpolation interpolation) {
  ElevationOptions options;
  options.interpolation = interpolation;
  return load(file, options);
}

double height_deg(const ElevationRaster& raster, double latitude_deg, double longitude_deg) {
  const auto height_m = raster.height_m(radians(latitude_deg), radians(longitude_deg));
  return height_m ? *height_m : std::numeric_limits<double>::quiet_NaN();
}

bool is_outside(const ElevationRaster& raster, double latitude_deg, double longitude_deg) {
  return !raster.height_m(radians(latitude_deg), radians(longitude_deg));
}

}  // namespace

TEST_CASE("A plane is reproduced by every interpolation, to the outermost posts", "[elevation]") {
  const TemporaryFolder folder;
  const AsciiGrid grid{7, 5, 11.0, 47.0, 0.01};
  const auto file = grid.write(folder, "plane", [](int column, int row) {
    return std::to_string(500.0 + 3.5 * column - 2.25 * row);
  });
  for (const Interpolation interpolation :
       {Interpolation::bilinear, Interpolation::cubic, Interpolation::cubic_spline}) {
    const ElevationRaster raster = load_as(file, interpolation);
    for (double column = 0.0; column <= 6.0; column += 0.3) {
      for (double row = 0.0; row <= 4.0; row += 0.4) {
        const double latitude_deg = 47.0 + (4.5 - row) * 0.01;
        const double longitude_deg = 11.0 + (column + 0.5) * 0.01;
        // Rounding of degrees to radians and back: 1e-13 deg, 1e-11 posts.
        CHECK(height_deg(raster, latitude_deg, longitude_deg) ==
              Approx(500.0 + 3.5 * column - 2.25 * row).margin(1e-8).epsilon(0.0));
      }
    }
    CHECK(is_outside(raster, 47.0 + 4.51 * 0.01, 11.03));
    CHECK(is_outside(raster, 47.02, 11.0 + 6.51 * 0.01));
    CHECK(is_outside(raster, 47.02, -168.97));
    CHECK(is_outside(raster, std::numeric_limits<double>::quiet_NaN(), 11.03));
  }
}

TEST_CASE("Bilinear and Catmull-Rom pass through posts, the B-spline beside them", "[elevation]") {
  const TemporaryFolder folder;
  const AsciiGrid grid{9, 9, 11.0, 47.0, 0.01};
  const auto file = grid.write(folder, "peak", [](int column, int row) {
    return std::string(column == 4 && row == 4 ? "36" : "0");
  });
  const ElevationRaster bilinear = load_as(file, Interpolation::bilinear);
  const ElevationRaster cubic = load_as(file, Interpolation::cubic);
  const ElevationRaster spline = load_as(file, Interpolation::cubic_spline);
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      const double expected_m = column == 4 && row == 4 ? 36.0 : 0.0;
      for (const auto* raster : {&bilinear, &cubic})
        CHECK(height_deg(*raster, grid.post_y(row), grid.post_x(column)) ==
              Approx(expected_m).epsilon(0.0).margin(1e-7));
    }
  }
  // Tensor products of the kernels' values: Catmull-Rom 9/16 half way, -1/16 at 3/2; B-spline
  // 2/3 and 1/6 at posts.
  const double half_way_deg = grid.post_x(4) + 0.005;
  CHECK(height_deg(bilinear, grid.post_y(4), half_way_deg) == Approx(18.0));
  CHECK(height_deg(cubic, grid.post_y(4), half_way_deg) == Approx(36.0 * 9 / 16));
  CHECK(height_deg(cubic, grid.post_y(4), half_way_deg + 0.01) == Approx(-36.0 / 16));
  CHECK(height_deg(spline, grid.post_y(4), grid.post_x(4)) == Approx(16.0));
  CHECK(height_deg(spline, grid.post_y(4), grid.post_x(5)) == Approx(4.0));
  CHECK(height_deg(spline, grid.post_y(3), grid.post_x(5)) == Approx(1.0));
}

TEST_CASE("A raster in UTM is looked up within the stated part of a pixel", "[elevation]") {
  const TemporaryFolder folder;
  AsciiGrid grid{200, 160, 640.0e3, 5.2e6, 250.0};
  grid.wkt = tests::kUtm32NorthWkt;
  // Height = column + row / 1000 in posts: the answer tells the position.
  const auto file = grid.write(
      folder, "utm", [](int column, int row) { return std::to_string(column + row * 0.001); });
  const ElevationRaster raster = load(file);
  double largest_error = 0.0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto words = core::random_words({1, core::kStreamTerrain, 0}, i, 0);
    const double column = 199.0 * core::uniform_from(words[0]);
    const double row = 159.0 * core::uniform_from(words[1]);
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    GeographicLib::UTMUPS::Reverse(32, true, 640.0e3 + 250.0 * (column + 0.5),
                                   5.2e6 + 250.0 * (159.5 - row), latitude_deg, longitude_deg);
    const double height = height_deg(raster, latitude_deg, longitude_deg);
    largest_error = std::max(largest_error, std::abs(height - column - 0.001 * row));
  }
  INFO("largest error " << largest_error << " pixels");
  CHECK(largest_error < kPixelMapAccuracy);
}

TEST_CASE("Rasters across the date line and with longitudes past 180 deg", "[elevation]") {
  const TemporaryFolder folder;
  for (const double west_deg : {179.5, -180.5, 349.5}) {
    const AsciiGrid grid{10, 10, west_deg, -5.0, 0.1};
    const auto file =
        grid.write(folder, "turn", [](int column, int) { return std::to_string(10 * column); });
    const ElevationRaster raster = load(file);
    for (int column = 0; column < 10; ++column)
      for (const double turn_deg : {-360.0, 0.0, 360.0})
        CHECK(height_deg(raster, -4.5, grid.post_x(column) + turn_deg) ==
              Approx(10.0 * column).epsilon(0.0).margin(1e-6));
    CHECK(is_outside(raster, -4.5, west_deg + 1.2));
  }
}

TEST_CASE("Voids are known by post and filled; a file of voids only is refused", "[elevation]") {
  const TemporaryFolder folder;
  const AsciiGrid grid{20, 20, 11.0, 47.0, 0.01};
  const auto file = grid.write(folder, "voids", [](int column, int row) {
    return std::string(row == 7 && column >= 3 && column < 6 ? "-9999" : "250");
  });
  const ElevationRaster raster = load(file);
  CHECK(raster.voids() == 3);
  int found = 0;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) found += raster.is_void(column, row) ? 1 : 0;
  CHECK(found == 3);
  for (const int column : {3, 4, 5}) CHECK(raster.is_void(column, 7));
  CHECK(raster.holes() == 0);
  CHECK(height_deg(raster, grid.post_y(7), grid.post_x(4)) == Approx(250.0));
  CHECK(raster.lowest_m() == Approx(250.0));

  const auto empty = grid.write(folder, "empty", [](int, int) { return std::string("-9999"); });
  CHECK_THAT(refusal_of_raster(empty), Contains("E-RANGE") && Contains("all 400"));
}

TEST_CASE("A void too wide to fill stays a hole and never a height", "[elevation]") {
  const TemporaryFolder folder;
  const AsciiGrid grid{300, 3, 11.0, 47.0, 0.001};
  const auto file = grid.write(folder, "wide", [](int column, int) {
    return std::string(column >= 20 && column < 280 ? "-9999" : "100");
  });
  const ElevationRaster raster = load(file);
  CHECK(raster.voids() == 780);
  CHECK(raster.holes() > 0);
  CHECK(raster.holes() < 780);
  CHECK(is_outside(raster, grid.post_y(1), grid.post_x(150)));
  CHECK(height_deg(raster, grid.post_y(1), grid.post_x(10)) == Approx(100.0));
}

TEST_CASE("Undeclared stand-ins for no height are refused", "[elevation]") {
  const TemporaryFolder folder;
  AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  for (const std::string stand_in : {"-32768", "-9998", "99999"}) {
    const auto file = grid.write(folder, "undeclared", [&](int column, int row) {
      return column == 2 && row == 1 ? stand_in : "10";
    });
    CHECK_THAT(refusal_of_raster(file), Contains("E-RANGE") && Contains("column 2, row 1"));
  }
}

TEST_CASE("Smoothing removes whole-metre terraces and stays within the rounding", "[elevation]") {
  const TemporaryFolder folder;
  const AsciiGrid grid{120, 40, 11.0, 47.0, 0.0003};
  const auto true_height_m = [](int column, int row) { return 580.3 + 0.17 * column + 0.06 * row; };
  const auto file = grid.write(folder, "terraces", [&](int column, int row) {
    return std::to_string(std::lround(true_height_m(column, row)));
  });
  ElevationOptions options;
  options.quantisation_step_m = 1.0;
  const ElevationRaster rounded = load(file);
  const ElevationRaster smooth = load(file, options);
  double rounded_squares = 0.0;
  double smooth_squares = 0.0;
  for (int row = 10; row < 30; ++row) {
    for (int column = 15; column < 105; ++column) {
      const double file_m = *rounded.post_height_m(column, row);
      const double smooth_m = *smooth.post_height_m(column, row);
      CHECK(std::abs(smooth_m - file_m) <= 0.5001);
      rounded_squares += std::pow(file_m - true_height_m(column, row), 2);
      smooth_squares += std::pow(smooth_m - true_height_m(column, row), 2);
    }
  }
  const double reduction = std::sqrt(smooth_squares / rounded_squares);
  INFO("RMS error falls to " << reduction << " of the rounding's");
  CHECK(reduction < 0.1);

  options.quantisation_step_m = -1.0;
  CHECK_THAT(refusal_of_raster(file, options), Contains("E-RANGE quantisation_step_m"));
}

TEST_CASE("Lookups from many threads agree with those of one", "[elevation]") {
  const TemporaryFolder folder;
  AsciiGrid grid{50, 50, 640.0e3, 5.2e6, 100.0};
  grid.wkt = tests::kUtm32NorthWkt;
  const auto file = grid.write(folder, "threads", [](int column, int row) {
    return std::to_string((column * 37 + row * 91) % 400);
  });
  const ElevationRaster raster = load(file);
  const GeodeticBox& box = raster.box();
  std::vector<double> heights_m(50'000);
  const auto height_at = [&](std::size_t i) {
    const auto words = core::random_words({2, core::kStreamTerrain, 0}, i, 0);
    const double u = core::uniform_from(words[0]);
    const double v = core::uniform_from(words[1]);
    return raster
        .height_m(box.south_rad + v * (box.north_rad - box.south_rad),
                  box.west_rad + u * (box.east_rad - box.west_rad))
        .value_or(-1.0);
  };
  core::parallel_for(heights_m.size(), [&](std::size_t i) { heights_m[i] = height_at(i); });
  std::size_t different = 0;
  for (std::size_t i = 0; i < heights_m.size(); ++i)
    different += heights_m[i] != height_at(i) ? 1 : 0;
  CHECK(different == 0);
}

}  // namespace fanbeam::terrain
