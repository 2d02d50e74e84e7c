// R14: rays that leave a surface neither meet it again nor miss what stands 5 cm above it.
#include "terrain/secondary_origin.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/random.h"
#include "terrain/ray_scene.h"

namespace {

using namespace fanbeam;

constexpr double kPlaneHalf_m = 3000.0;
constexpr double kOccluder_m = 0.05;

// A slope without round numbers, so that every vertex is rounded.
double slope_m(double x_m, double y_m) { return 0.0371 * x_m - 0.0213 * y_m + 123.4567; }

terrain::HeightField plane(double shift_m) {
  terrain::HeightField field =
      terrain::make_height_field(shift_m - kPlaneHalf_m, shift_m - kPlaneHalf_m,
                                 shift_m + kPlaneHalf_m, shift_m + kPlaneHalf_m, 20);
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i)
      field.height_m[field.post(i, j)] =
          slope_m(field.west_m + field.spacing_m * i, field.south_m + field.spacing_m * j);
  return field;
}

// The same slope 5 cm higher, as a mesh.
terrain::PlacedMesh occluder(double shift_m) {
  terrain::PlacedMesh placed;
  for (const double y_m : {shift_m - kPlaneHalf_m, shift_m + kPlaneHalf_m})
    for (const double x_m : {shift_m - kPlaneHalf_m, shift_m + kPlaneHalf_m})
      placed.mesh.vertices_m.emplace_back(x_m, y_m, slope_m(x_m, y_m) + kOccluder_m);
  placed.mesh.triangles = {{0, 1, 3}, {0, 3, 2}};
  placed.mesh.triangle_material.assign(2, 0);
  placed.mesh.material_names = {"lid"};
  placed.material_of_name = {0};
  return placed;
}

struct Counts {
  int rays = 0, self_hits = 0, found = 0;
};

Counts leave_the_surface(double shift_m) {
  const terrain::RayScene bare(plane(shift_m), {}, {});
  const terrain::RayScene covered(plane(shift_m), {}, {occluder(shift_m)});
  const core::RandomKey key{14, 0, 0};
  constexpr int kHits = 3400;
  constexpr int kRaysPerHit = 100;
  Counts counts;
  for (int i = 0; i < kHits; ++i) {
    const auto word = core::random_words(key, static_cast<std::uint64_t>(i), 0);
    const auto u = [&](int k) { return core::uniform_from(word[static_cast<std::size_t>(k)]); };
    const double x_m = shift_m + (u(0) - 0.5) * kPlaneHalf_m,
                 y_m = shift_m + (u(1) - 0.5) * kPlaneHalf_m;
    const glm::dvec3 sensor_m(shift_m + (u(2) - 0.5) * kPlaneHalf_m, shift_m - 0.9 * kPlaneHalf_m,
                              slope_m(shift_m, shift_m) + 100.0 + 100.0 * u(3));
    const glm::dvec3 path_m = glm::dvec3(x_m, y_m, slope_m(x_m, y_m)) - sensor_m;
    const auto hit = bare.intersect(sensor_m, path_m, 2.0 * glm::length(path_m));
    if (!hit) continue;
    const glm::dvec3 at_m = sensor_m + glm::normalize(path_m) * hit->distance_m;
    const glm::dvec3 start_m = terrain::secondary_origin_m(at_m, hit->normal, hit->distance_m);
    const glm::dvec3 along = glm::normalize(glm::cross(hit->normal, glm::dvec3(0.3, 0.9, 0.1)));
    const glm::dvec3 across = glm::cross(hit->normal, along);
    for (int k = 0; k < kRaysPerHit; ++k) {
      const auto turn =
          core::random_words(key, static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(k + 1));
      // From 0.05 to 90 deg, evenly on a logarithmic scale.
      const double grazing_rad = core::kPi / 2 * std::pow(0.05 / 90.0, core::uniform_from(turn[0]));
      const double azimuth_rad = 2.0 * core::kPi * core::uniform_from(turn[1]);
      const glm::dvec3 direction =
          std::cos(grazing_rad) * (std::cos(azimuth_rad) * along + std::sin(azimuth_rad) * across) +
          std::sin(grazing_rad) * hit->normal;
      constexpr double kFar_m = 500.0;
      ++counts.rays;
      if (bare.intersect(start_m, direction, kFar_m)) ++counts.self_hits;
      const auto lid = covered.intersect(start_m, direction, kFar_m);
      if (lid && lid->geometry != terrain::kTerrainGeometry) ++counts.found;
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("R14 no secondary ray meets its own surface, and none misses a lid 5 cm above",
          "[secondary]") {
  int rays = 0;
  for (const double shift_m : {0.0, 1000.0, 10000.0}) {
    const Counts counts = leave_the_surface(shift_m);
    INFO("frame shifted by " << shift_m << " m, " << counts.rays << " rays");
    CHECK(counts.self_hits == 0);
    CHECK(counts.found >= 0.999 * counts.rays);
    rays += counts.rays;
  }
  CHECK(rays >= 1'000'000);
}

TEST_CASE("The offset grows with coordinates and distance and stays below the 5 cm of R14",
          "[secondary]") {
  CHECK(terrain::secondary_offset_m({0.0, 0.0, 0.0}, 0.0) == 0.0);
  CHECK(terrain::secondary_offset_m({1000.0, -20.0, 3.0}, 1000.0) == Approx(1.9e-3).epsilon(0.01));
  CHECK(terrain::secondary_offset_m({-10000.0, 10000.0, 50.0}, 4000.0) < 0.015);
}

TEST_CASE("What rays hit does not depend on how the library is told they lie", "[secondary]") {
  const terrain::RayScene scene(plane(0.0), {}, {occluder(0.0)});
  constexpr int kLanes = 8;
  alignas(32) int active[kLanes];
  std::fill(active, active + kLanes, -1);
  int hits = 0;
  for (std::uint64_t n = 0; n < 4000; ++n) {
    terrain::RayPacket<kLanes> alike;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto word =
          core::random_words({15, 0, 0}, kLanes * n + static_cast<std::uint64_t>(lane), 0);
      const auto u = [&](int k) { return core::uniform_from(word[static_cast<std::size_t>(k)]); };
      const glm::dvec3 start_m((u(0) - 0.5) * kPlaneHalf_m, (u(1) - 0.5) * kPlaneHalf_m, 400.0);
      const double turn_rad = 2.0 * core::kPi * u(2);
      alike.aim(lane, scene.in_caster_m(start_m),
                {std::cos(turn_rad), std::sin(turn_rad), 0.3 - 1.3 * u(3)}, 2000.0);
    }
    terrain::RayPacket<kLanes> apart = alike;
    scene.intersect(active, alike, terrain::Packing::alike);
    scene.intersect(active, apart, terrain::Packing::apart);
    for (int lane = 0; lane < kLanes; ++lane) {
      REQUIRE(alike.geometry[lane] == apart.geometry[lane]);
      REQUIRE(alike.distance[lane] == apart.distance[lane]);
      if (alike.geometry[lane] == terrain::kNoHit) continue;
      ++hits;
      REQUIRE(alike.primitive[lane] == apart.primitive[lane]);
    }
  }
  CHECK(hits > 10'000);
}
