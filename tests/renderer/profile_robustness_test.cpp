// Hard cases of the profile caster: no thread, order, pose or geometry upsets it.
#include <catch2/catch.hpp>

#include "core/parallel.h"
#include "core/pose.h"
#include "renderer/frame_renderer.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using tests::kGrass;
using tests::kHeight_m;
using tests::kWall;
using tests::same_bytes;

namespace {

bool all_good(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value) && value >= 0.0; });
}

terrain::HeightField random_ground(double half_m, double spacing_m, double relief_m,
                                   std::uint64_t seed) {
  std::uint64_t post = 0;
  return tests::ground(half_m, spacing_m, [&](double, double) {
    return relief_m * (tests::uniform(seed, ++post) - 0.5);
  });
}

renderer::World village(const sensors::Sensor& sensor) {
  std::vector<tests::Body> houses;
  for (int i = 0; i < 40; ++i) {
    const double x = -60.0 + 17.0 * (i % 8), y = 300.0 + 160.0 * (i / 8) + 13.0 * (i % 5);
    houses.push_back(tests::box({x, y, -20.0}, {x + 14.0, y + 11.0, 15.0}, 1));
  }
  return tests::world(sensor, random_ground(1500.0, 25.0, 12.0, 31), {kGrass, kWall},
                      std::move(houses));
}

// A prism for the profile caster only, whatever its rings.
terrain::Solid solid(std::vector<glm::dvec2> ring_m, double top_m) {
  return {{std::move(ring_m)}, top_m, 1, 1};
}

// Rings that no building should have, around (x, y).
std::vector<terrain::Solid> impossible_solids(double x, double y, double top_m) {
  return {
      solid({{x, y}, {x, y}, {x, y}}, top_m),                                      // a point
      solid({{x, y}, {x + 20.0, y}}, top_m),                                       // a line
      solid({{x, y}, {x + 10.0, y + 10.0}, {x + 20.0, y + 20.0}}, top_m),          // collinear
      solid({{x, y}, {x + 20.0, y + 20.0}, {x + 20.0, y}, {x, y + 20.0}}, top_m),  // a bow tie
      solid({{x, y}, {x, y + 20.0}, {x + 20.0, y + 20.0}, {x + 20.0, y}}, top_m),  // clockwise
      solid({{x, y}, {x + 20.0, y}, {x + 20.0, y}, {x + 20.0, y + 20.0}, {x, y + 20.0}, {x, y}},
            top_m),                                                                // points twice
      solid({{x, y}, {x + 1e-9, y}, {x + 1e-9, y + 1e-9}, {x, y + 1e-9}}, top_m),  // tiny
      solid({{x - 1e6, y}, {x + 1e6, y}, {x + 1e6, y + 1e6}, {x - 1e6, y + 1e6}}, top_m),  // vast
  };
}

}  // namespace

TEST_CASE("R10 profile frames have the same bytes for 1 and 2 threads, again and in any order",
          "[profile]") {
  for (const sensors::ScanSurface surface :
       {sensors::ScanSurface::plane, sensors::ScanSurface::cone})
    for (const bool stabilised : {true, false}) {
      sensors::Sensor sensor = tests::hivision(12);
      sensor.range.cells = 180;
      sensor.scan.surface = surface;
      sensor.scan.stabilised = stabilised;
      const renderer::World world = village(sensor);
      const renderer::FrameRenderer frames(world, renderer::profile_sampling_for(16.0), {},
                                           {{core::EffectId::thermal_noise}});
      renderer::FramePose pose = tests::level_pose(90.0), other_pose = tests::level_pose(70.0);
      pose.q_NB = core::quaternion_from({0.1, -0.05, 0.2});
      const renderer::Frame expected = frames.render(pose);
      const renderer::Frame other = frames.render(other_pose);
      CHECK(all_good(expected.bscope_W));
      CHECK(all_good(expected.cscope_W_m3));
      CHECK_FALSE(same_bytes(expected.bscope_W, other.bscope_W));
      for (const int threads : {1, 2}) {
        const core::ThreadLimit limit(threads);
        const renderer::Frame again_other = frames.render(other_pose);
        const renderer::Frame again = frames.render(pose);
        CHECK(same_bytes(again.bscope_W, expected.bscope_W));
        CHECK(same_bytes(again.cscope_W_m3, expected.cscope_W_m3));
        CHECK(same_bytes(again.bscope_grey, expected.bscope_grey));
        CHECK(same_bytes(again.cscope_grey, expected.cscope_grey));
        CHECK(same_bytes(again_other.bscope_W, other.bscope_W));
        CHECK(same_bytes(again_other.cscope_W_m3, other.cscope_W_m3));
        CHECK(again.blanked == expected.blanked);
      }
    }
}

TEST_CASE("No power is negative or not a number, whatever the ground, the buildings and the pose",
          "[profile]") {
  const double reliefs_m[] = {0.0, 0.01, 20.0, 2000.0, 2e5};
  const double clearances_m[] = {1e-3, 1.0, 60.0, 3000.0};
  for (std::uint64_t trial = 0; trial < 120; ++trial) {
    const auto random = [&](std::uint32_t draw) { return tests::uniform(32, trial, draw); };
    sensors::Sensor sensor = trial % 4 == 0 ? tests::even_hivision(3) : tests::hivision(3);
    sensor.range.minimum_m = trial % 5 == 0 ? 0.0 : 50.0;
    sensor.range.cells = 120;
    sensor.scan.surface = trial % 2 == 0 ? sensors::ScanSurface::plane : sensors::ScanSurface::cone;
    renderer::World world = tests::world(
        sensor, random_ground(600.0, trial % 3 == 0 ? 7.3 : 120.0, reliefs_m[trial % 5], trial),
        {kGrass, kWall});
    for (std::uint32_t i = 0; i < 30; ++i) {
      const double x = 120.0 * (random(100 + i) - 0.5), y = 500.0 * (random(200 + i) - 0.1);
      const double top_m = i % 3 == 0 ? 0.0 : 80.0 * (random(300 + i) - 0.2);
      for (terrain::Solid& each : impossible_solids(x, y, i == 7 ? 1e5 : top_m))
        tests::solids_of(world).prisms.push_back(std::move(each));
      if (i % 8 == 0) tests::solids_of(world).prisms.pop_back();  // few vast ones
    }
    const glm::dvec2 place(trial % 7 == 0 ? glm::dvec2(0.0)
                                          : 60.0 * glm::dvec2(random(0), random(1)));
    const double ground_m = *world.surfaces().terrain()->height_at(place.x, place.y);
    sensors::AntennaFrame antenna = tests::level_antenna(
        {place.x, place.y, ground_m + clearances_m[trial % 4]}, trial % 3 == 0 ? 0.0 : random(2));
    if (trial % 6 >= 3) {
      const double roll_rad = trial % 6 == 3 ? core::kPi / 2 : 3.0 * (random(3) - 0.5);
      const glm::dvec3 up = antenna.up, right = antenna.right;
      antenna.up = std::cos(roll_rad) * up + std::sin(roll_rad) * right;
      antenna.right = std::cos(roll_rad) * right - std::sin(roll_rad) * up;
    }
    INFO("trial " << trial);
    const renderer::FanSums sums = tests::cast_profile(world, 4, antenna, true);
    CHECK(all_good(sums.range_W_per_rad));
    CHECK(all_good(sums.elevation_W_m3_per_rad));
  }
}

TEST_CASE("A sensor 1 mm above level ground sees the closed form", "[profile]") {
  sensors::Sensor sensor = tests::even_hivision(2);
  sensor.range.cells = 100;
  const renderer::World world = tests::world(
      sensor, tests::ground(1000.0, 10.0, [](double, double) { return 0.0; }), {tests::kGamma});
  const renderer::FanSums sums =
      tests::cast_profile(world, 2, tests::level_antenna({3.0, 2.0, 1e-3}));
  const std::vector<double> expected =
      tests::closed_form(sensor, {{{0.0, -1e-3}, {sensor.range.maximum_m(), -1e-3}}});
  for (int sub = 0; sub < sums.sub_columns; ++sub)
    CHECK(tests::largest_error(sums, sub, expected) < 1e-9);
}

TEST_CASE("A wall exactly along a slice stays where it is", "[profile]") {
  // One long side of each building lies on a radius from the sensor: a slice exactly through it may
  // count as left or right of it or as touching it somewhere, but only ranges of the building and
  // its shadow may tell.
  sensors::Sensor sensor = tests::even_hivision(6);
  sensor.range.cells = 120;
  constexpr double kFront_m = 300.0, kBack_m = 340.0, kTop_m = 20.0;
  const double from_m = std::hypot(kFront_m, kHeight_m - kTop_m);
  const double to_m = std::hypot(kBack_m * kHeight_m / (kHeight_m - kTop_m), kHeight_m);
  for (int turn = 0; turn < 40; ++turn) {
    const double heading_rad = 0.37 * turn;
    const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m}, heading_rad);
    renderer::World world =
        tests::world(sensor, tests::ground(1100.0, 100.0, [](double, double) { return 0.0; }),
                     {tests::kGamma, tests::kGamma});
    const renderer::FanSums open = tests::cast_profile(world, 1, antenna);
    for (int sub = 0; sub < open.sub_columns; ++sub) {
      const double left_rad = heading_rad + tests::slice_azimuth_rad(open, sub);
      const double right_rad = left_rad + 0.4 * open.step_rad;
      const glm::dvec2 left(std::sin(left_rad), std::cos(left_rad));
      const glm::dvec2 right(std::sin(right_rad), std::cos(right_rad));
      tests::solids_of(world).prisms.push_back(
          solid({kFront_m * left, kBack_m * left, kBack_m * right, kFront_m * right}, kTop_m));
      std::reverse(tests::solids_of(world).prisms.back().rings_m[0].begin(),
                   tests::solids_of(world).prisms.back().rings_m[0].end());
    }
    const renderer::FanSums built = tests::cast_profile(world, 1, antenna);
    double largest = 0.0;
    for (std::size_t i = 0; i < built.range_W_per_rad.size(); ++i) {
      const double near_m =
          sensor.range.minimum_m + sensor.range.cell_m * static_cast<double>(i % 120);
      if (near_m + sensor.range.cell_m > from_m && near_m < to_m) continue;
      largest =
          std::max(largest, std::abs(built.range_W_per_rad[i] / open.range_W_per_rad[i] - 1.0));
    }
    INFO("heading " << heading_rad);
    CHECK(largest < 1e-9);
  }
}

TEST_CASE("The rim of the ground hides what lies behind it from a sensor outside", "[profile]") {
  // The southern row of posts stands 30 m high and falls away from a sensor south of it: its back
  // is dark but hides.
  sensors::Sensor sensor = tests::even_hivision(2);
  sensor.range.cells = 200;
  const renderer::World world = tests::world(
      sensor, tests::ground(500.0, 10.0, [](double, double y) { return y <= -500.0 ? 30.0 : 0.0; }),
      {tests::kGamma});
  const renderer::FanSums sums =
      tests::cast_profile(world, 2, tests::level_antenna({3.0, -900.0, 60.0}));
  double worst = 0.0;
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double cosine = std::cos(tests::slice_azimuth_rad(sums, sub));
    const double rim_m = 400.0 / cosine, end_m = rim_m * 60.0 / 30.0;
    worst = std::max(
        worst,
        tests::largest_error(
            sums, sub, tests::closed_form(sensor, {{{end_m, -60.0}, {1400.0 / cosine, -60.0}}})));
  }
  CHECK(worst < 1e-9);
}
