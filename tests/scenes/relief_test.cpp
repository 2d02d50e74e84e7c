// What mirrored rays may meet of the ground by its squares, against rays.
#include "scenes/relief.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "core/errors.h"
#include "scenes/sight_map.h"
#include "sensors/sensor_file.h"
#include "terrain/ray_scene.h"
#include "terrain/secondary_origin.h"
#include "tests/scenes/effect_draws.h"

namespace fanbeam::tests {
namespace {

// To the east of an antenna over the origin, wider than its fan.
terrain::HeightField eastern_ground(const std::function<double(double, double)>& height_m) {
  terrain::HeightField ground = terrain::make_height_field(-500.0, -2000.0, 4500.0, 2000.0, 20.0);
  for (int j = 0; j < ground.rows; ++j)
    for (int i = 0; i < ground.columns; ++i)
      ground.height_m[ground.post(i, j)] =
          height_m(ground.west_m + ground.spacing_m * i, ground.south_m + ground.spacing_m * j);
  return ground;
}

struct EastwardLook {
  explicit EastwardLook(double height_m) {
    core::ProblemList problems;
    sensor =
        sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
    antenna.position_m.z = height_m;
    antenna.forward = {1.0, 0.0, 0.0};
    antenna.right = {0.0, -1.0, 0.0};
  }

  bool by_map(const terrain::HeightField& ground) const {
    return scenes::SightMap(ground, {}, {})
        .with_mirrors({true})
        .seen_from(antenna, sensor)
        .mirrored_rays_end;
  }

  // Whether one of many rays, all of whose ways are within range, meets ground twice.
  bool by_rays(const terrain::HeightField& ground) const {
    const terrain::RayScene surfaces(ground, {}, {});
    const double far_m = sensor.range.maximum_m();
    const auto ends = [&](const glm::dvec3& direction) {
      const auto mirror = surfaces.intersect(antenna.position_m, direction, far_m);
      if (!mirror) return false;
      const double sine = -glm::dot(direction, mirror->normal);
      if (!(sine > 0.0)) return false;
      const glm::dvec3 start_m = terrain::secondary_origin_m(
          antenna.position_m + mirror->distance_m * direction, mirror->normal, mirror->distance_m);
      const glm::dvec3 onwards = direction + 2.0 * sine * mirror->normal;
      const auto end = surfaces.intersect(start_m, onwards, far_m);
      return end &&
             mirror->distance_m + end->distance_m +
                     glm::distance(start_m + end->distance_m * onwards, antenna.position_m) <=
                 2.0 * far_m;
    };
    for (double azimuth_deg = -20.0; azimuth_deg <= 20.0; azimuth_deg += 2.0)
      for (double away_m = 250.0; away_m < far_m; away_m += 10.0)
        if (ends(sensors::direction(antenna, core::radians(azimuth_deg),
                                    -std::atan(antenna.position_m.z / away_m),
                                    sensor.scan.surface)))
          return true;
    return false;
  }

  sensors::Sensor sensor;
  sensors::AntennaFrame antenna;
};

}  // namespace

// The steepest facet within range stood for all of them: 3.4 deg down were not enough for one of 2.9.
TEST_CASE("A bank ends what the ground before it mirrors where it is the steeper of the two",
          "[scenes][frame_plan]") {
  constexpr double kSlope = 0.05, kFoot_m = 3000.0;
  for (const auto& [climbs, meets] : {std::pair(0.8, true), {1.5, false}}) {
    const EastwardLook look(climbs * kSlope * kFoot_m);
    const auto bank = eastern_ground(
        [](double east_m, double) { return std::clamp((east_m - kFoot_m) * kSlope, 0.0, 2.0); });
    INFO("a ray mirrored before it climbs by " << climbs << " of its slope");
    CHECK(look.by_rays(bank) == meets);
    CHECK(look.by_map(bank) == meets);
    // What lies before it falls away from the antenna, and its rays climb by as much less, twice.
    const auto ridge = eastern_ground([](double east_m, double) {
      const double beyond_m = east_m - kFoot_m;
      return beyond_m < 0.0 ? std::clamp(3.0 - std::abs(beyond_m + 100.0) * 0.03, 0.0, 3.0)
                            : std::min(beyond_m * kSlope, 2.0);
    });
    CHECK(look.by_rays(ridge));
    CHECK(look.by_map(ridge));
  }
}

TEST_CASE("No ray that the ground mirrors meets any where the map knows of none",
          "[scenes][frame_plan]") {
  int met = 0, left_out = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    Draws draws(seed);
    struct Wave {
      double slope, length_m, turn_rad, phase_rad;
    };
    std::vector<Wave> waves(static_cast<std::size_t>(draws.whole(1, 3)));
    for (Wave& wave : waves)
      wave = {draws.scaled(0.001, 0.08), draws.scaled(60.0, 1800.0),
              draws.between(0.0, 2.0 * core::kPi), draws.between(0.0, 2.0 * core::kPi)};
    const auto height_m = [&](double east_m, double north_m) {
      double sum_m = 0.0;
      for (const Wave& wave : waves) {
        const double per_m = 2.0 * core::kPi / wave.length_m;
        sum_m += wave.slope / per_m *
                 std::sin(wave.phase_rad + per_m * (east_m * std::cos(wave.turn_rad) +
                                                    north_m * std::sin(wave.turn_rad)));
      }
      return sum_m;
    };
    const terrain::HeightField ground = eastern_ground(height_m);
    const EastwardLook look(height_m(0.0, 0.0) + draws.scaled(20.0, 500.0));
    const bool ends = look.by_rays(ground), may = look.by_map(ground);
    INFO("terrain " << seed << ", from " << look.antenna.position_m.z << " m");
    CHECK((may || !ends));
    met += ends ? 1 : 0;
    left_out += may ? 0 : 1;
  }
  // Both answers came up.
  CHECK(met > 10);
  CHECK(left_out > 10);
}

}  // namespace fanbeam::tests
