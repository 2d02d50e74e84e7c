// T01, T02: geometry that lies far from where floats are fine.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "terrain/local_frame.h"
#include "terrain/ray_scene.h"

namespace fanbeam::terrain {
namespace {

constexpr double kHalf_m = 4000.0;
constexpr double kSensor_m = 60.0;
constexpr int kMeasuredRays = 20'000;

const core::Geodetic kCentre{core::radians(47.26), core::radians(11.34), 0.0};

// A point of the plane that touches the ellipsoid at kCentre, on its way through Earth-centred
// coordinates.
glm::dvec3 ecef_of_plane_m(const LocalFrame& frame, double east_m, double north_m,
                           double above_m = 0.0) {
  return ecef_from_geodetic(frame.to_geodetic({east_m, north_m, above_m}));
}

HeightField patch(const LocalFrame& frame, double spacing_m) {
  HeightField field = make_height_field(-kHalf_m, -kHalf_m, kHalf_m, kHalf_m, spacing_m);
  double worst_m = 0.0;
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i) {
      const double east_m = field.west_m + spacing_m * i, north_m = field.south_m + spacing_m * j;
      const glm::dvec3 local_m =
          frame.to_local_m(geodetic_from_ecef(ecef_of_plane_m(frame, east_m, north_m)));
      worst_m = std::max(worst_m, glm::distance(local_m, {east_m, north_m, 0.0}));
      field.height_m[field.post(i, j)] = local_m.z;
    }
  CHECK(worst_m < 2e-8);
  return field;
}

struct Ray {
  double range_m = 0.0;  // exact
  glm::dvec3 direction{0.0};
};

// Any azimuth, ranges evenly on a logarithmic scale, to the plane kSensor_m below.
Ray ray(std::uint64_t i) {
  const auto words = core::random_words({1, 1, 0}, i, 0);
  const double azimuth_rad = 2.0 * core::kPi * core::uniform_from(words[0]);
  const double range_m = 200.0 * std::pow(3700.0 / 200.0, core::uniform_from(words[1]));
  const double sine = kSensor_m / range_m, cosine = std::sqrt(1.0 - sine * sine);
  return {range_m, {cosine * std::sin(azimuth_rad), cosine * std::cos(azimuth_rad), -sine}};
}

struct RangeErrors {
  double median_m = 0.0, largest_m = 0.0;
  double largest_refined_m = 0.0;  // with the triangle that was hit, in double
};

RangeErrors range_errors(const RayScene& scene, const glm::dvec3& sensor_m,
                         const glm::dmat3& axes) {
  std::vector<double> errors_m;
  RangeErrors errors;
  alignas(32) int active[8];
  std::fill_n(active, 8, -1);
  for (std::uint64_t first = 0; first < kMeasuredRays; first += 8) {
    RayPacket<8> packet;
    for (int i = 0; i < 8; ++i)
      packet.aim(i, scene.in_caster_m(sensor_m),
                 axes * ray(first + static_cast<std::uint64_t>(i)).direction, 6000.0);
    scene.intersect(active, packet);
    for (int i = 0; i < 8; ++i) {
      REQUIRE(packet.geometry[i] != kNoHit);
      const Ray sent = ray(first + static_cast<std::uint64_t>(i));
      errors_m.push_back(std::abs(static_cast<double>(packet.distance[i]) - sent.range_m));
      const auto corners = scene.triangle(packet.geometry[i], packet.primitive[i]);
      const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double refined_m =
          glm::dot(normal, corners[0] - sensor_m) / glm::dot(normal, axes * sent.direction);
      errors.largest_refined_m =
          std::max(errors.largest_refined_m, std::abs(refined_m - sent.range_m));
    }
  }
  std::sort(errors_m.begin(), errors_m.end());
  errors.median_m = errors_m[errors_m.size() / 2];
  errors.largest_m = errors_m.back();
  return errors;
}

// The plane as a mesh in Earth-centred coordinates, as a caster without a local frame has it.
PlacedMesh earth_centred(const LocalFrame& frame, double spacing_m) {
  PlacedMesh placed;
  const int posts = static_cast<int>(2.0 * kHalf_m / spacing_m) + 1;
  for (int j = 0; j < posts; ++j)
    for (int i = 0; i < posts; ++i)
      placed.mesh.vertices_m.push_back(
          ecef_of_plane_m(frame, -kHalf_m + spacing_m * i, -kHalf_m + spacing_m * j));
  for (int j = 0; j + 1 < posts; ++j)
    for (int i = 0; i + 1 < posts; ++i) {
      const auto sw = static_cast<std::uint32_t>(j * posts + i);
      const auto nw = sw + static_cast<std::uint32_t>(posts);
      placed.mesh.triangles.emplace_back(sw, sw + 1, nw + 1);
      placed.mesh.triangles.emplace_back(sw, nw + 1, nw);
    }
  placed.mesh.triangle_material.assign(placed.mesh.triangles.size(), 0);
  placed.mesh.material_names = {"ground"};
  placed.material_of_name = {0};
  return placed;
}

}  // namespace

TEST_CASE("T01: planet-sized coordinates cost 5 cm of range at most, and 1 um in double",
          "[far_coordinates]") {
  const LocalFrame frame(kCentre);
  for (const double spacing_m : {10.0, 30.0}) {
    const RayScene scene(patch(frame, spacing_m), {}, {});
    const glm::dvec3 sensor_m =
        frame.to_local_m(geodetic_from_ecef(ecef_of_plane_m(frame, 0.0, 0.0, kSensor_m)));
    const RangeErrors errors = range_errors(scene, sensor_m, glm::dmat3(1.0));
    INFO("posts " << spacing_m << " m apart: median " << errors.median_m << " m, largest "
                  << errors.largest_m << " m, in double " << errors.largest_refined_m << " m");
    CHECK(errors.largest_m <= 0.05);
    CHECK(errors.largest_refined_m <= 1e-6);
  }
}

TEST_CASE("T01: the same plane in Earth-centred floats is metres off", "[far_coordinates]") {
  const LocalFrame frame(kCentre);
  const glm::dvec3 origin_m = ecef_of_plane_m(frame, 0.0, 0.0);
  glm::dmat3 axes;  // east, north and up in Earth-centred axes
  axes[0] = (ecef_of_plane_m(frame, 1000.0, 0.0) - origin_m) / 1000.0;
  axes[1] = (ecef_of_plane_m(frame, 0.0, 1000.0) - origin_m) / 1000.0;
  axes[2] = (ecef_of_plane_m(frame, 0.0, 0.0, 1000.0) - origin_m) / 1000.0;
  const RayScene scene(std::nullopt, {}, {earth_centred(frame, 40.0)});
  const RangeErrors errors = range_errors(scene, origin_m + kSensor_m * axes[2], axes);
  INFO("median " << errors.median_m << " m, largest " << errors.largest_m << " m");
  CHECK(errors.median_m > 0.5);
  CHECK(errors.largest_m > 5.0);
}

TEST_CASE("T02: ranges do not depend on what is added to every height", "[far_coordinates]") {
  // Level, and rolling so that every height is rounded.
  for (const double swell_m : {0.0, 0.5}) {
    std::vector<double> lowland_m;
    for (const double added_m : {0.0, 581.0, 2500.0, 5000.0}) {
      HeightField field = make_height_field(-kHalf_m, -kHalf_m, kHalf_m, kHalf_m, 30.0);
      for (int j = 0; j < field.rows; ++j)
        for (int i = 0; i < field.columns; ++i)
          field.height_m[field.post(i, j)] =
              added_m + swell_m * std::sin(i / 17.0) * std::cos(j / 23.0);
      const RayScene scene(std::move(field), {}, {});
      std::vector<double> ranges_m;
      for (std::uint64_t i = 0; i < kMeasuredRays; ++i) {
        const auto hit = scene.intersect({0.0, 0.0, kSensor_m + added_m}, ray(i).direction, 6000.0);
        REQUIRE(hit);
        ranges_m.push_back(hit->distance_m);
      }
      if (lowland_m.empty()) lowland_m = ranges_m;
      double worst_m = 0.0;
      for (std::size_t i = 0; i < ranges_m.size(); ++i)
        worst_m = std::max(worst_m, std::abs(ranges_m[i] - lowland_m[i]));
      INFO("swell " << swell_m << " m, " << added_m << " m added: " << worst_m << " m");
      CHECK(worst_m <= 1e-3);
    }
  }
}

}  // namespace fanbeam::terrain
