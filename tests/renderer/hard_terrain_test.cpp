// T07, T12, T13: coplanar surfaces, one huge triangle, a sensor in the ground.
#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "core/random.h"
#include "renderer/frame_renderer.h"
#include "renderer/stages/frame_echoes.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;

TEST_CASE("T13 a sensor in or on the ground sees noise alone and is flagged", "[robust]") {
  const renderer::World world =
      tests::world(tests::hivision(8),
                   tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }), {kGrass});
  const renderer::FrameRenderer frames(world, {}, {}, {{core::EffectId::thermal_noise}});
  const renderer::World nothing = tests::world(tests::hivision(8), std::nullopt, {kGrass});
  const renderer::Frame noise = renderer::render_frame(
      nothing, {}, {}, {{core::EffectId::thermal_noise}}, tests::level_pose(60.0));
  CHECK(frames.render(tests::level_pose(1e-3)).events.empty());
  for (const double height_m : {-1.0, 0.0, -0.0, -1e-300}) {
    const renderer::Frame frame = frames.render(tests::level_pose(height_m));
    CHECK(frame.events == std::vector<std::string>{"below_terrain"});
    for (const double power_W : frame.bscope_W) CHECK(power_W == 0.0);
    for (const double power_W_m3 : frame.cscope_W_m3) CHECK(power_W_m3 == 0.0);
    CHECK(frame.bscope_grey == noise.bscope_grey);
    CHECK(frame.cscope_grey == noise.cscope_grey);
  }
}

TEST_CASE("T13 echoes for signals of a sensor in or on the ground are none and flagged",
          "[robust]") {
  renderer::World world =
      tests::world(tests::hivision(8),
                   tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }), {kGrass});
  renderer::PointTarget above;
  above.rcs = materials::ConstantRcs{10.0};
  above.path = {{0.0, {0.0, 1000.0, 20.0}}};
  world.targets = {above};
  CHECK(renderer::frame_echoes(world, tests::level_pose(1.0), {}).events.empty());
  for (const double height_m : {-1.0, 0.0}) {
    const renderer::FrameEchoes found =
        renderer::frame_echoes(world, tests::level_pose(height_m), {});
    CHECK(found.events == std::vector<std::string>{"below_terrain"});
    CHECK(found.echoes.empty());
    CHECK(found.rays == 0);
  }
}

TEST_CASE("T13 a C-scope of flat ground is black and flagged where no ground is below",
          "[robust]") {
  sensors::Sensor sensor = tests::hivision(8);
  using Mode = sensors::Display::CScopeMode;
  for (const Mode mode : {Mode::flat_earth, Mode::shadow}) {
    sensor.display.cscope_mode = mode;
    const renderer::World nothing = tests::world(sensor, std::nullopt, {kGrass});
    const renderer::World ground = tests::world(
        sensor, tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }), {kGrass});
    for (const renderer::World* world : {&nothing, &ground})
      for (const double height_m : {0.0, -5.0}) {
        const renderer::Frame frame = renderer::render_frame(
            *world, {}, {}, {{core::EffectId::thermal_noise}}, tests::level_pose(height_m));
        INFO(height_m << " m" << (world == &nothing ? " over nothing" : ""));
        CHECK(std::count(frame.events.begin(), frame.events.end(), "below_terrain") == 1);
        for (const double power_W_m3 : frame.cscope_W_m3) CHECK(power_W_m3 == 0.0);
      }
    // Whoever asks for no C-scope has all that was asked for.
    const renderer::Frame bscope = renderer::render_frame(
        nothing, {}, {.cscope = false}, {{core::EffectId::thermal_noise}}, tests::level_pose(-5.0));
    CHECK(bscope.events == std::vector<std::string>{"empty_view"});
  }
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
  const terrain::RayScene bare(field, {}, {});
  const glm::dvec3 sensor(3.0, -1900.0, 581.3 - 0.0037 * 1900.0 + 90.0);
  // Alone, and over a wider strip that was loaded before it.
  for (const std::vector<terrain::SurfacePatch>& patches :
       {std::vector<terrain::SurfacePatch>{runway}, {under, runway}}) {
    const terrain::RayScene scene(field, patches, {});
    int wrong = 0;
    double lift_m = 0.0, worst_m = 0.0;
    for (std::uint64_t i = 0; i < 30'000; ++i) {
      const auto words = core::random_words({7, 300, 0}, i, 0);
      const double x = (core::uniform_from(words[0]) - 0.5) * 44.9;
      const double y = (core::uniform_from(words[1]) - 0.5) * 1999.9;
      const glm::dvec3 target(x, y, 0.011 * x + 0.0037 * y + 581.3);
      const auto hit = scene.intersect(sensor, target - sensor, 5000.0);
      const auto ground = bare.intersect(sensor, target - sensor, 5000.0);
      REQUIRE(hit);
      REQUIRE(ground);
      if (hit->material != 7) ++wrong;
      lift_m = std::max(lift_m, std::abs(hit->distance_m - ground->distance_m));
      worst_m = std::max(worst_m, std::abs(hit->distance_m - glm::length(target - sensor)));
    }
    // The patch has no height of its own, so no range changes; what rounding does to the plane
    // itself is the caster's float error.
    CHECK(wrong == 0);
    CHECK(lift_m == 0.0);
    CHECK(worst_m < 0.02);
  }
}

TEST_CASE("T12 ranges on a huge triangle beside tiny ones stay within 1.5 mm, 50 km off the origin",
          "[robust]") {
  // Where floats lie 4 mm apart. Of level ground the caster needs no difference of large numbers.
  const glm::dvec3 middle_m(40000.3, 30000.1, 0.0);
  terrain::PlacedMesh mesh;
  mesh.mesh.vertices_m = {{-10000.0, -10000.0, 0.0}, {10000.0, -10000.0, 0.0},
                          {10000.0, 10000.0, 0.0},   {-10000.0, 10000.0, 0.0},
                          {5000.0, 5000.0, 0.001},   {5000.01, 5000.0, 0.001},
                          {5000.0, 5000.01, 0.001}};
  for (glm::dvec3& vertex_m : mesh.mesh.vertices_m) vertex_m += middle_m;
  mesh.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  mesh.mesh.triangle_material = {0, 0, 0};
  mesh.mesh.material_names = {"ground"};
  mesh.material_of_name = {0};
  const terrain::RayScene scene(std::nullopt, {}, {mesh});
  const glm::dvec3 sensor_m = middle_m + glm::dvec3(0.0, 0.0, 60.0);
  double worst_m = 0.0, worst_by_point_m = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double range_m = 200.0 * std::pow(4500.0 / 200.0, i / 1999.0);
    const double sine = 60.0 / range_m;
    const double azimuth = 0.7 * i;
    const glm::dvec3 direction(std::sqrt(1.0 - sine * sine) * std::sin(azimuth),
                               std::sqrt(1.0 - sine * sine) * std::cos(azimuth), -sine);
    const auto hit = scene.intersect(sensor_m, direction, 6000.0);
    REQUIRE(hit);
    worst_m = std::max(worst_m, std::abs(hit->distance_m - range_m));
    const glm::vec3 point_m =
        glm::vec3(sensor_m) + glm::vec3(direction) * static_cast<float>(hit->distance_m);
    worst_by_point_m = std::max(worst_by_point_m,
                                std::abs(glm::distance(glm::dvec3(point_m), sensor_m) - range_m));
  }
  CHECK(worst_m < 0.0015);
  CHECK(worst_by_point_m > 0.002);  // the short way: a hit point in floats
}
