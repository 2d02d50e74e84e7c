// R04, R05: rays that hardly come down, and the horizon.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "terrain/ray_scene.h"

namespace fanbeam::terrain {
namespace {

glm::dvec3 direction(double azimuth_rad, double depression_rad) {
  const double cosine = std::cos(depression_rad);
  return {cosine * std::sin(azimuth_rad), cosine * std::cos(azimuth_rad),
          -std::sin(depression_rad)};
}

// Level ground to 10 km, as terrain of many posts or as two triangles.
std::vector<std::unique_ptr<RayScene>> level_grounds() {
  std::vector<std::unique_ptr<RayScene>> grounds;
  grounds.push_back(
      std::make_unique<RayScene>(make_height_field(-10000.0, -10000.0, 10000.0, 10000.0, 40.0),
                                 std::vector<SurfacePatch>{}, std::vector<PlacedMesh>{}));
  PlacedMesh sheet;
  sheet.mesh.vertices_m = {{-10000.0, -10000.0, 0.0},
                           {10000.0, -10000.0, 0.0},
                           {10000.0, 10000.0, 0.0},
                           {-10000.0, 10000.0, 0.0}};
  sheet.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  sheet.mesh.triangle_material = {0, 0};
  sheet.mesh.material_names = {"ground"};
  sheet.material_of_name = {0};
  grounds.push_back(std::make_unique<RayScene>(std::nullopt, std::vector<SurfacePatch>{},
                                               std::vector<PlacedMesh>{std::move(sheet)}));
  return grounds;
}

}  // namespace

TEST_CASE("R04: ranges at vanishing grazing angles are within float rounding, or there are none",
          "[grazing]") {
  constexpr double kFar_m = 9000.0;  // the maximum range; the ground goes on
  for (const auto& ground : level_grounds())
    for (const double height_m : {0.05, 1.0, 60.0})
      for (const double depression_deg : {1.0, 0.1, 0.01, 0.001, 0.0}) {
        const double sine = std::sin(core::radians(depression_deg));
        const double range_m = sine > 0.0 ? height_m / sine : HUGE_VAL;
        int wrong = 0;
        for (int i = 0; i < 1000; ++i) {
          const auto hit = ground->intersect(
              {0.0, 0.0, height_m}, direction(0.7 * i, core::radians(depression_deg)), kFar_m);
          const double allowed_m = 4.0 * 0x1p-24 * range_m / sine;
          const bool right =
              range_m > kFar_m ? !hit : hit && std::abs(hit->distance_m - range_m) <= allowed_m;
          wrong += right ? 0 : 1;
        }
        INFO("height " << height_m << " m, depression " << depression_deg << " deg");
        CHECK(wrong == 0);
      }
}

TEST_CASE("R04: a ray that lies in the plane returns nothing", "[grazing]") {
  for (const auto& ground : level_grounds()) {
    int hits = 0;
    for (int i = 0; i < 1000; ++i)
      hits += ground->intersect({0.0, 0.0, 0.0}, direction(0.7 * i, 0.0), 9000.0) ? 1 : 0;
    CHECK(hits == 0);
  }
}

TEST_CASE("R05: the ground ends at a dip of 0.215347 degrees from 60 m, nothing returns above it",
          "[grazing]") {
  // Smooth ball of 4/3 of the Earth; posts 20 m apart lie 6 um above the chords between them.
  constexpr double kRadius_m = 4.0 / 3.0 * 6371000.0, kHeight_m = 60.0;
  HeightField ball = make_height_field(-30.0, -10.0, 30.0, 40000.0, 20.0);
  for (int j = 0; j < ball.rows; ++j)
    for (int i = 0; i < ball.columns; ++i) {
      const double x_m = ball.west_m + 20.0 * i, y_m = ball.south_m + 20.0 * j;
      const double square_m2 = x_m * x_m + y_m * y_m;
      ball.height_m[ball.post(i, j)] =
          -square_m2 / (kRadius_m + std::sqrt(kRadius_m * kRadius_m - square_m2));
    }
  const RayScene scene(std::move(ball), {}, {});
  double ground_rad = core::radians(0.3), sky_rad = 0.0;
  while (ground_rad - sky_rad > core::radians(1e-9)) {
    const double middle_rad = (ground_rad + sky_rad) / 2;
    const bool hit =
        scene.intersect({0.0, 0.0, kHeight_m}, direction(0.0, middle_rad), 40000.0).has_value();
    (hit ? ground_rad : sky_rad) = middle_rad;
  }
  // atan(sqrt(2 a h + h^2) / a).
  CHECK(core::degrees(std::atan(std::sqrt((2.0 * kRadius_m + kHeight_m) * kHeight_m) /
                                kRadius_m)) == Approx(0.215347).margin(1e-6).epsilon(0.0));
  CHECK(core::degrees(ground_rad) == Approx(0.215347).margin(1e-6).epsilon(0.0));
  for (int i = 1; i <= 1000; ++i)
    REQUIRE_FALSE(scene.intersect({0.0, 0.0, kHeight_m},
                                  direction(0.0, sky_rad - core::radians(1e-6 * i)), 40000.0));
}

}  // namespace fanbeam::terrain
