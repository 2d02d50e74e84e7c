#include "terrain/geoid.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/units.h"

namespace fanbeam::terrain {
namespace {

double geoid_deg(double latitude_deg, double longitude_deg) {
  return egm96_geoid_height_m(core::radians(latitude_deg), core::radians(longitude_deg));
}

}  // namespace

TEST_CASE("EGM96 heights agree with the values published with the model", "[geoid]") {
  struct Row {
    double latitude_deg, longitude_deg, height_m;
  };
  // NGA, EGM96 harmonic synthesis program F477, its sample OUTPUT.DAT (full series, not the grid).
  const std::vector<Row> rows = {
      {38.6281550, 269.7791550, -31.628}, {-14.6212170, 305.0211140, -2.969},
      {46.8743190, 102.4487290, -43.575}, {-23.6174460, 133.8747120, 15.871},
      {38.6254730, 359.9995000, 50.066},  {-0.4667440, 0.0023000, 17.329}};
  for (const Row& row : rows) {
    CAPTURE(row.latitude_deg, row.longitude_deg);
    // Bilinear interpolation of a 15-minute grid.
    CHECK(std::abs(geoid_deg(row.latitude_deg, row.longitude_deg) - row.height_m) < 0.15);
  }
}

TEST_CASE("EGM96 at Timbuktu as in GeographicLib's manual", "[geoid]") {
  // GeoidEval(1): 16:46:33N 3:00:34W gives 28.7068 m.
  CHECK(std::abs(geoid_deg(16.0 + 46.0 / 60 + 33.0 / 3600, -(3.0 + 34.0 / 3600)) - 28.7068) < 0.1);
}

TEST_CASE("Mean sea level at Innsbruck is about 50 m above the ellipsoid", "[geoid]") {
  CHECK(std::abs(geoid_deg(47.26, 11.34) - 50.0) < 2.0);
}

TEST_CASE("The geoid is continuous at the poles and round the date line", "[geoid]") {
  // Grid values of EGM96: 13.61 m and -29.53 m.
  for (const double longitude_deg : {-180.0, -77.0, 0.0, 180.0, 540.0}) {
    CHECK(std::abs(geoid_deg(90.0, longitude_deg) - 13.606) < 1e-2);
    CHECK(std::abs(geoid_deg(-90.0, longitude_deg) + 29.534) < 1e-2);
  }
  CHECK(std::abs(geoid_deg(10.0, 179.9999) - geoid_deg(10.0, -179.9999)) < 1e-2);
  CHECK(geoid_deg(10.0, 190.0) == Approx(geoid_deg(10.0, -170.0)).epsilon(1e-12));
}

TEST_CASE("Geoid heights asked for by many threads are those of one", "[geoid]") {
  constexpr std::size_t kPoints = 20'000;
  std::vector<double> heights_m(kPoints);
  const auto height_at = [](std::size_t i) {
    return geoid_deg(-80.0 + 0.008 * static_cast<double>(i), 0.017 * static_cast<double>(i));
  };
  core::parallel_for(kPoints, [&](std::size_t i) { heights_m[i] = height_at(i); });
  std::size_t different = 0;
  for (std::size_t i = 0; i < kPoints; ++i) different += heights_m[i] != height_at(i) ? 1 : 0;
  CHECK(different == 0);
}

TEST_CASE("Geoid positions outside their domain are refused", "[geoid]") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(geoid_deg(90.5, 0.0), Contains("E-RANGE"));
  CHECK_THROWS_WITH(geoid_deg(0.0, std::numeric_limits<double>::infinity()),
                    Contains("E-NONFINITE"));
}

TEST_CASE("A missing geoid grid is an error that names the package", "[geoid]") {
  const char* before = std::getenv("PROJ_DATA");
  const std::string saved = before != nullptr ? before : "";
  setenv("PROJ_DATA", "/nonexistent", 1);
  std::string message;
  // A new thread opens the grid anew.
  std::thread([&message] {
    try {
      egm96_geoid_height_m(0.8, 0.2);
    } catch (const core::InputError& error) {
      message = error.what();
    }
  }).join();
  if (before != nullptr) {
    setenv("PROJ_DATA", saved.c_str(), 1);
  } else {
    unsetenv("PROJ_DATA");
  }
  CHECK_THAT(message, Catch::Matchers::Contains("E-IO") && Catch::Matchers::Contains("proj-data"));
}

}  // namespace fanbeam::terrain
