// Hard cases of the renderer: see the catalogue names in the test names.
#include <catch2/catch.hpp>
#include <cstring>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "tests/renderer/test_worlds.h"

namespace {

using namespace fanbeam;

const materials::PhongNrcs kGrass(0.0325, 0.136, 1.99);
const materials::PhongNrcs kDark;

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

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("R10 the same bytes for any number of threads, any order of frames and again",
          "[robust]") {
  const renderer::World world = village(40);
  const renderer::FrameRenderer frames(world, renderer::sampling_for(8.0), {},
                                       {.thermal_noise = true});
  const renderer::Frame expected = frames.render(tests::level_pose(90.0));
  const renderer::Frame other = frames.render(tests::level_pose(70.0));
  CHECK_FALSE(same_bytes(expected.bscope_W, other.bscope_W));
  for (const int threads : {1, 2, 3, 4, 8, 16}) {
    const core::ThreadLimit limit(threads);
    const renderer::Frame again_other = frames.render(tests::level_pose(70.0));
    const renderer::Frame again = frames.render(tests::level_pose(90.0));
    CHECK(same_bytes(again.bscope_W, expected.bscope_W));
    CHECK(same_bytes(again.cscope_W_m3, expected.cscope_W_m3));
    CHECK(same_bytes(again.bscope_grey, expected.bscope_grey));
    CHECK(same_bytes(again_other.bscope_W, other.bscope_W));
    CHECK(again.rays == expected.rays);
  }
}

TEST_CASE("R16 nothing in view gives a picture of noise and says so", "[robust]") {
  const sensors::Sensor sensor = tests::hivision(8);
  SECTION("no geometry at all") {
    const renderer::World world = tests::world(sensor, std::nullopt, {kGrass});
    const renderer::Frame frame = renderer::FrameRenderer(world, {}, {}, {.thermal_noise = true})
                                      .render(tests::level_pose(60.0));
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
    const renderer::Frame frame = renderer::FrameRenderer(world, {}, {}, {.thermal_noise = true})
                                      .render(tests::level_pose(60.0));
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
    const renderer::Frame frame = renderer::FrameRenderer(world, {}, {}, {.thermal_noise = true})
                                      .render(tests::level_pose(60.0));
    check_finite(frame);
    CHECK(frame.events == std::vector<std::string>{"empty_view"});
  }
  SECTION("a picture of one pixel") {
    sensors::Sensor tiny = tests::hivision(1);
    tiny.range.cells = 1;
    tiny.display.cscope_rows = 1;
    const renderer::World world = tests::world(tiny, rolling_ground(), {kGrass});
    check_finite(renderer::FrameRenderer(world, {}, {}, {.thermal_noise = true})
                     .render(tests::level_pose(60.0)));
  }
}

TEST_CASE("T13 a sensor in or on the ground sees noise alone and is flagged", "[robust]") {
  const renderer::World world =
      tests::world(tests::hivision(8),
                   tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }), {kGrass});
  const renderer::FrameRenderer frames(world, {}, {}, {.thermal_noise = true});
  for (const double height_m : {-1.0, 0.0}) {
    const renderer::Frame frame = frames.render(tests::level_pose(height_m));
    check_finite(frame);
    CHECK(frame.events == std::vector<std::string>{"below_terrain"});
    for (const double power_W : frame.bscope_W) CHECK(power_W == 0.0);
  }
}

TEST_CASE("M02 a perfectly dark surface equals the noise-only picture exactly", "[robust]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const renderer::World dark = tests::world(sensor, rolling_ground(), {kDark});
  const renderer::World nothing = tests::world(sensor, std::nullopt, {kDark});
  for (const bool noise : {true, false}) {
    const renderer::Frame a = renderer::FrameRenderer(dark, {}, {}, {.thermal_noise = noise})
                                  .render(tests::level_pose(80.0));
    const renderer::Frame b = renderer::FrameRenderer(nothing, {}, {}, {.thermal_noise = noise})
                                  .render(tests::level_pose(80.0));
    CHECK(same_bytes(a.bscope_grey, b.bscope_grey));
    CHECK(same_bytes(a.cscope_grey, b.cscope_grey));
    if (!noise)
      for (const double grey : a.bscope_grey) CHECK(grey == 0.0);
  }
}

TEST_CASE("R12 invalid rays are refused before the cast and the process lives", "[robust]") {
  const renderer::World world = tests::world(tests::hivision(2), rolling_ground(), {kGrass});
  const terrain::RayScene& scene = *world.surfaces;
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

TEST_CASE("R12 an impossible pose is refused by name", "[robust]") {
  const renderer::World world = tests::world(tests::hivision(2), rolling_ground(), {kGrass});
  const renderer::FrameRenderer frames(world, {}, {}, {.thermal_noise = true});
  renderer::FramePose pose = tests::level_pose(60.0);
  pose.position_m.x = std::nan("");
  CHECK_THROWS_AS(frames.render(pose), core::InputError);
  pose.position_m.x = 1e9;
  CHECK_THROWS_AS(frames.render(pose), core::InputError);
}

TEST_CASE("T07 a runway coplanar with sloping terrain wins every ray, whatever the order",
          "[robust]") {
  // Posts every 17.3 m on one plane, a runway of 2000 m x 45 m painted on it.
  terrain::HeightField field = tests::ground(
      17.3 * 120, 17.3, [](double x, double y) { return 0.011 * x + 0.0037 * y + 581.3; });
  const terrain::SurfacePatch runway =
      terrain::rectangle_patch({0.0, 0.0}, {0.0, 1.0}, 2000.0, 45.0, 7);
  const terrain::SurfacePatch under =
      terrain::rectangle_patch({0.0, 0.0}, {0.0, 1.0}, 2100.0, 60.0, 3);
  const terrain::RayScene scene(field, {under, runway}, {});
  const core::RandomKey key{7, 300, 0};
  int wrong = 0;
  double worst_m = 0.0;
  const glm::dvec3 sensor(3.0, -1900.0, 581.3 - 0.0037 * 1900.0 + 90.0);
  for (std::uint64_t i = 0; i < 30'000; ++i) {
    const auto words = core::random_words(key, i, 0);
    const double x = (core::uniform_from(words[0]) - 0.5) * 44.9;
    const double y = (core::uniform_from(words[1]) - 0.5) * 1999.9;
    const glm::dvec3 target(x, y, 0.011 * x + 0.0037 * y + 581.3);
    const auto hit = scene.intersect(sensor, target - sensor, 5000.0);
    REQUIRE(hit);
    if (hit->material != 7) ++wrong;
    worst_m = std::max(worst_m, std::abs(hit->distance_m - glm::length(target - sensor)));
  }
  // The patch has no height of its own, so only the float range error of 0.1 m / sin(psi) order is
  // left: at 1.3 deg grazing a height rounding of 3e-5 m (float at 580 m) moves the hit by a few
  // millimetres.
  CHECK(wrong == 0);
  CHECK(worst_m < 0.02);
}

TEST_CASE("T12 ranges on a huge triangle beside tiny ones stay within 5 mm", "[robust]") {
  terrain::PlacedMesh mesh;
  mesh.mesh.vertices_m = {{-10000.0, -10000.0, 0.0}, {10000.0, -10000.0, 0.0},
                          {10000.0, 10000.0, 0.0},   {-10000.0, 10000.0, 0.0},
                          {5000.0, 5000.0, 0.001},   {5000.001, 5000.0, 0.001},
                          {5000.0, 5000.001, 0.001}};
  mesh.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  mesh.mesh.triangle_material = {0, 0, 0};
  mesh.mesh.material_names = {"ground"};
  mesh.material_of_name = {0};
  const terrain::RayScene scene(std::nullopt, {}, {mesh});
  double worst_m = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double range_m = 200.0 * std::pow(4500.0 / 200.0, i / 1999.0);
    const double sine = 60.0 / range_m;
    const double azimuth = 0.7 * i;
    const glm::dvec3 direction(std::sqrt(1.0 - sine * sine) * std::sin(azimuth),
                               std::sqrt(1.0 - sine * sine) * std::cos(azimuth), -sine);
    const auto hit = scene.intersect({0.0, 0.0, 60.0}, direction, 6000.0);
    REQUIRE(hit);
    // The direction is rounded to floats inside: that alone moves a hit at 0.76 deg by R 6e-8 / tan
    // psi.
    worst_m = std::max(
        worst_m, std::abs(hit->distance_m - range_m) - range_m * 6e-8 / std::tan(std::asin(sine)));
  }
  CHECK(worst_m < 0.005);
}

TEST_CASE("R14 what stands on the ground is visible, what stands behind a wall is not",
          "[robust]") {
  renderer::World world = tests::world(
      tests::hivision(40), tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
      {kDark, kDark}, {tests::box({-30.0, 1000.0, 0.0}, {30.0, 1001.0, 20.0}, 1)});
  const auto add = [&](const char* name, double x, double y, double z) {
    world.targets.push_back(
        {name, materials::ConstantRcs{1.0}, {{0.0, {x, y, z}}}, glm::dmat3(1.0)});
  };
  add("light before the wall", 0.0, 990.0, 0.3);
  add("light behind the wall", 0.0, 1050.0, 0.3);
  add("light beside the wall", 60.0, 1050.0, 0.3);
  const renderer::Frame frame =
      renderer::FrameRenderer(world, {}, {true, false}, {}).render(tests::level_pose(60.0));
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
