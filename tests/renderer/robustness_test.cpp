// Hard cases of the renderer: see the catalogue names in the test names.
#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <limits>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/frame_renderer.h"
#include "tests/renderer/usual_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using tests::kBlack;
using tests::kGrass;
using tests::same_bytes;

namespace {

terrain::HeightField rolling_ground() {
  return tests::ground(4000.0, 40.0, [](double x, double y) {
    return 8.0 * std::sin(x / 170.0) * std::cos(y / 230.0);
  });
}

renderer::World village(int columns) {
  std::vector<tests::Body> houses;
  for (int i = 0; i < 40; ++i) {
    const double x = -400.0 + 97.0 * (i % 8);
    const double y = 700.0 + 260.0 * (i / 8) + 13.0 * (i % 5);
    houses.push_back(tests::box({x, y, -20.0}, {x + 14.0, y + 11.0, 15.0}, 1));
  }
  return tests::world(tests::hivision(columns), rolling_ground(),
                      {kGrass, materials::PhongNrcs(0.3, 0.5, 3.0)}, std::move(houses));
}

void check_finite(const renderer::Frame& frame) {
  for (const auto* values :
       {&frame.bscope_W, &frame.cscope_W_m3, &frame.bscope_grey, &frame.cscope_grey})
    for (const double value : *values) REQUIRE((std::isfinite(value) && value >= 0.0));
}

}  // namespace

TEST_CASE("R10 the same bytes for any number of threads, any order of frames and again",
          "[robust]") {
  const renderer::World world = village(40);
  const renderer::FrameRenderer frames(world, renderer::sampling_for(8.0), {},
                                       {{core::EffectId::thermal_noise}});
  const renderer::Frame expected = frames.render(tests::level_pose(90.0));
  const renderer::Frame other = frames.render(tests::level_pose(70.0));
  CHECK_FALSE(same_bytes(expected.bscope_W, other.bscope_W));
  for (const int threads : {1, 2, 3, 4, 8, 16}) {
    const core::ThreadLimit limit(threads);
    for (int run = 0; run < 5; ++run) {
      const renderer::Frame again_other = frames.render(tests::level_pose(70.0));
      const renderer::Frame again = frames.render(tests::level_pose(90.0));
      CHECK(same_bytes(again.bscope_W, expected.bscope_W));
      CHECK(same_bytes(again.cscope_W_m3, expected.cscope_W_m3));
      CHECK(same_bytes(again.bscope_grey, expected.bscope_grey));
      CHECK(same_bytes(again_other.bscope_W, other.bscope_W));
      CHECK(again.rays == expected.rays);
    }
  }
}

TEST_CASE("R10 the same bytes with groups handed out in random order", "[robust]") {
  const renderer::World world = village(40);
  const renderer::RayCaster caster(world, renderer::sampling_for(8.0));
  const sensors::AntennaFrame antenna{
      {0.0, 0.0, 90.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  renderer::FanSums expected;
  caster.cast(antenna, true, expected);
  for (std::uint32_t run = 0; run < 5; ++run) {
    renderer::FanSums sums;
    renderer::lay_out_fan(world, renderer::sampling_for(8.0), true, sums);
    std::vector<std::uint32_t> groups = renderer::groups_of(sums);
    for (std::size_t i = groups.size() - 1; i > 0; --i)
      std::swap(groups[i], groups[core::random_words({10, 400, 0}, i, run)[0] % (i + 1)]);
    const core::ThreadLimit limit(static_cast<int>(run) + 1);
    caster.cast_groups(antenna, true, 0, groups, sums);
    CHECK(same_bytes(sums.range_W_per_rad, expected.range_W_per_rad));
    CHECK(same_bytes(sums.elevation_W_m3_per_rad, expected.elevation_W_m3_per_rad));
  }
}

TEST_CASE("R16 nothing in view gives a picture of noise and says so", "[robust]") {
  const sensors::Sensor sensor = tests::hivision(8);
  SECTION("no geometry at all") {
    const renderer::World world = tests::world(sensor, std::nullopt, {kGrass});
    const renderer::Frame frame = renderer::render_frame(
        world, {}, {}, {{core::EffectId::thermal_noise}}, tests::level_pose(60.0));
    check_finite(frame);
    CHECK(frame.events == std::vector<std::string>{"empty_view"});
    for (const double power_W : frame.bscope_W) CHECK(power_W == 0.0);
    CHECK(frame.bscope_grey.back() > 0.0);  // noise shows in the farthest cell
  }
  SECTION("one triangle") {
    terrain::PlacedMesh one;
    one.mesh.vertices_m = {{-50.0, 1000.0, 0.0}, {50.0, 1000.0, 0.0}, {0.0, 1000.0, 60.0}};
    one.mesh.triangles = {{0, 1, 2}};
    one.mesh.triangle_material = {0};
    one.mesh.material_names = {"wall"};
    one.material_of_name = {0};
    const renderer::World world = tests::world(sensor, std::nullopt, {kGrass}, {one});
    const renderer::Frame frame = renderer::render_frame(
        world, {}, {}, {{core::EffectId::thermal_noise}}, tests::level_pose(60.0));
    check_finite(frame);
    CHECK(frame.events.empty());
    // All of the triangle's power lies in the one or two cells of a wall at 1000 m.
    double in_cells_W = 0.0, total_W = 0.0;
    for (int cell = 0; cell < sensor.range.cells; ++cell) {
      const double range_m = sensor.range.minimum_m + sensor.range.cell_m * cell;
      for (int column = 0; column < sensor.scan.columns; ++column) {
        const double power_W =
            frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + column)];
        total_W += power_W;
        if (range_m > 985.0 && range_m < 1010.0) in_cells_W += power_W;
      }
    }
    CHECK(total_W > 0.0);
    CHECK(in_cells_W == Approx(total_W));
  }
  SECTION("all of it behind the sensor") {
    const renderer::World world =
        tests::world(sensor, std::nullopt, {kGrass},
                     {tests::box({-50.0, -900.0, 0.0}, {50.0, -800.0, 50.0}, 0)});
    const renderer::Frame frame = renderer::render_frame(
        world, {}, {}, {{core::EffectId::thermal_noise}}, tests::level_pose(60.0));
    check_finite(frame);
    CHECK(frame.events == std::vector<std::string>{"empty_view"});
  }
  SECTION("a picture of one pixel") {
    sensors::Sensor tiny = tests::hivision(1);
    tiny.range.cells = 1;
    tiny.display.cscope_rows = 1;
    const renderer::World world = tests::world(tiny, rolling_ground(), {kGrass});
    check_finite(renderer::render_frame(world, {}, {}, {{core::EffectId::thermal_noise}},
                                        tests::level_pose(60.0)));
  }
}

TEST_CASE("M02 a perfectly dark surface equals the noise-only picture exactly", "[robust]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const renderer::World dark = tests::world(sensor, rolling_ground(), {kBlack});
  const renderer::World nothing = tests::world(sensor, std::nullopt, {kBlack});
  for (const bool noise : {true, false}) {
    const renderer::Effects effects{core::EffectSet{}.with(core::EffectId::thermal_noise, noise)};
    const renderer::Frame a =
        renderer::render_frame(dark, {}, {}, effects, tests::level_pose(80.0));
    const renderer::Frame b =
        renderer::render_frame(nothing, {}, {}, effects, tests::level_pose(80.0));
    CHECK(same_bytes(a.bscope_grey, b.bscope_grey));
    CHECK(same_bytes(a.cscope_grey, b.cscope_grey));
    if (!noise)
      for (const double grey : a.bscope_grey) CHECK(grey == 0.0);
  }
}

TEST_CASE("R12 invalid rays are refused before the cast and the process lives", "[robust]") {
  const renderer::World world = tests::world(tests::hivision(2), rolling_ground(), {kGrass});
  const terrain::RayScene& scene = world.surfaces();
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 up(0.0, 0.0, 1.0), origin(0.0, 0.0, 50.0);
  const auto refused = [&](const glm::dvec3& from, const glm::dvec3& direction, double far_m,
                           core::ErrorClass expected) {
    try {
      scene.intersect(from, direction, far_m);
    } catch (const core::InputError& error) {
      return error.has(expected);
    }
    return false;
  };
  CHECK(refused({nan, 0.0, 0.0}, up, 100.0, core::ErrorClass::nonfinite));
  CHECK(refused(origin, {nan, 0.0, 1.0}, 100.0, core::ErrorClass::nonfinite));
  CHECK(refused(origin, {infinity, 0.0, 1.0}, 100.0, core::ErrorClass::nonfinite));
  CHECK(refused(origin, {1e20, 0.0, 0.0}, 100.0, core::ErrorClass::range));
  CHECK(refused({1e19, 0.0, 0.0}, up, 100.0, core::ErrorClass::range));
  CHECK(refused(origin, up, nan, core::ErrorClass::nonfinite));
  CHECK_THROWS_AS(terrain::check_ray(origin, up, -1.0, 100.0), core::InputError);
  CHECK_THROWS_AS(terrain::check_ray(origin, up, nan, 100.0), core::InputError);
  // These two miss, as a ray of no direction or no length should.
  CHECK_FALSE(scene.intersect(origin, {0.0, 0.0, 0.0}, 100.0));
  CHECK_FALSE(scene.intersect(origin, -up, -1.0));

  const core::RandomKey key{12, 200, 0};
  int hits = 0;
  int refusals = 0;
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    const auto words = core::random_words(key, i, 0);
    const auto more = core::random_words(key, i, 1);
    float values[7];
    std::memcpy(values, words.data(), 16);
    std::memcpy(values + 4, more.data(), 12);  // any bit pattern: NaN, infinities, denormals, huge
    try {
      hits += scene.intersect({values[0], values[1], values[2]}, {values[3], values[4], values[5]},
                              values[6])
                  ? 1
                  : 0;
    } catch (const core::InputError&) {
      ++refusals;
    }
  }
  CHECK(refusals > 100'000);
  CHECK(hits < 1'000'000 - refusals);
}

TEST_CASE("R12 an impossible pose is refused by class, and the next frame is rendered",
          "[robust]") {
  renderer::World world = tests::world(tests::hivision(2), rolling_ground(), {kGrass});
  world.sensor.scan.stabilised = false;
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  using Change = std::function<void(renderer::FramePose&)>;
  for (const renderer::CasterKind kind :
       {renderer::CasterKind::rays, renderer::CasterKind::profile}) {
    const renderer::FrameRenderer frames(world, renderer::sampling_for(kind, 2.0), {},
                                         {{core::EffectId::thermal_noise}});
    const renderer::Frame expected = frames.render(tests::level_pose(60.0));
    const auto refused = [&](core::ErrorClass error_class, const Change& change) {
      renderer::FramePose pose = tests::level_pose(60.0);
      change(pose);
      bool as_expected = false;
      try {
        frames.render(pose);
      } catch (const core::InputError& error) {
        as_expected = error.has(error_class);
      }
      CHECK(as_expected);
      CHECK(same_bytes(frames.render(tests::level_pose(60.0)).bscope_W, expected.bscope_W));
    };
    for (const double bad : {nan, infinity}) {
      refused(core::ErrorClass::nonfinite, [&](auto& pose) { pose.position_m.x = bad; });
      refused(core::ErrorClass::nonfinite, [&](auto& pose) { pose.q_NB.w = bad; });
      refused(core::ErrorClass::nonfinite, [&](auto& pose) { pose.north_east_down[2][1] = bad; });
      refused(core::ErrorClass::nonfinite, [&](auto& pose) { pose.time_s = bad; });
    }
    refused(core::ErrorClass::range, [](auto& pose) { pose.position_m.x = 1e9; });
    refused(core::ErrorClass::range, [](auto& pose) { pose.q_NB = {0.0, 0.0, 0.0, 0.0}; });
    refused(core::ErrorClass::range, [](auto& pose) { pose.north_east_down = glm::dmat3(0.0); });
    refused(core::ErrorClass::range, [](auto& pose) { pose.north_east_down[0] *= 1e20; });
  }
}

TEST_CASE("R14 what stands on the ground is visible, what stands behind a wall is not",
          "[robust]") {
  renderer::World world = tests::world(
      tests::hivision(40), tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
      {kBlack, kBlack}, {tests::box({-30.0, 1000.0, 0.0}, {30.0, 1001.0, 20.0}, 1)});
  const auto add = [&](const char* name, double x, double y, double z) {
    world.targets.push_back(
        {name, materials::ConstantRcs{1.0}, {{0.0, {x, y, z}}}, glm::dmat3(1.0)});
  };
  add("light before the wall", 0.0, 990.0, 0.3);
  add("light behind the wall", 0.0, 1050.0, 0.3);
  add("light beside the wall", 60.0, 1050.0, 0.3);
  const renderer::Frame frame =
      renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(60.0));
  const sensors::Sensor& sensor = world.sensor;
  const auto power_W = [&](double x, double y) {
    const double range_m = std::sqrt(x * x + y * y + 59.7 * 59.7);
    const int cell = static_cast<int>((range_m - sensor.range.minimum_m) / sensor.range.cell_m);
    const int column = static_cast<int>((std::atan2(x, y) + sensor.scan.field_of_view_rad / 2) /
                                        sensor.scan.column_width_rad());
    return frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + column)];
  };
  CHECK(power_W(0.0, 990.0) > 0.0);
  CHECK(power_W(0.0, 1050.0) == 0.0);
  CHECK(power_W(60.0, 1050.0) > 0.0);
}
