// T02, T08, R05, R13 as pictures: heights with a large constant, meshes with rubbish in them, the
// end of a ball, and ground without gaps.
#include <catch2/catch.hpp>
#include <cstring>

#include "core/units.h"
#include "terrain/mesh.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;
using tests::kHeight_m;

namespace {

renderer::Frame frame_over(const renderer::World& world, const renderer::Sampling& sampling,
                           double height_m) {
  return renderer::render_frame(world, sampling, {}, {{core::EffectId::thermal_noise}},
                                tests::level_pose(height_m));
}

// Share of cells that differ by more than 0.001 dB.
double share_apart(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i] && !(std::abs(10.0 * std::log10(a[i] / b[i])) <= 1e-3)) ++apart;
  return static_cast<double>(apart) / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("T02: pictures do not depend on what is added to every height", "[closed_terrain]") {
  for (const double swell_m : {0.0, 0.5})
    for (const renderer::Sampling& sampling :
         {renderer::sampling_for(4.0), renderer::profile_sampling_for(4.0)}) {
      const auto picture = [&](double added_m) {
        const auto height_m = [&](double x_m, double y_m) {
          return added_m + swell_m * std::sin(x_m / 170.0) * std::cos(y_m / 230.0);
        };
        return frame_over(
            tests::world(tests::hivision(12), tests::ground(4000.0, 30.0, height_m), {kGrass}),
            sampling, kHeight_m + added_m);
      };
      const renderer::Frame lowland = picture(0.0);
      for (const double added_m : {581.0, 2500.0, 5000.0}) {
        const renderer::Frame highland = picture(added_m);
        INFO("swell " << swell_m << " m, " << added_m << " m added");
        CHECK(share_apart(highland.bscope_W, lowland.bscope_W) <= 1e-4);
        CHECK(share_apart(highland.cscope_W_m3, lowland.cscope_W_m3) <= 1e-4);
      }
    }
}

TEST_CASE("T08: the picture of a mesh with rubbish in it is that of the clean one",
          "[closed_terrain]") {
  const terrain::PlacedMesh clean = tests::box({-40.0, 900.0, 0.0}, {40.0, 930.0, 25.0}, 0).mesh;
  terrain::PlacedMesh dirty = clean;
  terrain::TriangleMesh& mesh = dirty.mesh;
  const auto count = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(),
                         {{0.0, 700.0, 10.0}, {0.0, 700.0, 20.0}, {0.0, 700.0, 30.0}});
  const std::vector<glm::uvec3> of_clean = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.begin() + 1, of_clean.begin(), of_clean.end());
  mesh.triangles.insert(mesh.triangles.end(),
                        {{0, 0, 1},                        // repeated index
                         {2, 2, 2},                        // all equal
                         {count, count + 1, count + 2}});  // on one line, before the box
  mesh.triangle_material.resize(mesh.triangles.size(), mesh.triangle_material.front());
  mesh.triangle_part.resize(mesh.triangles.size(), 0);
  core::ProblemList problems;
  terrain::check_and_clean(mesh, "box.glb", problems);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "W-DEGENERATE");
  const auto picture = [](const terrain::PlacedMesh& body) {
    return frame_over(tests::world(tests::hivision(12),
                                   tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }),
                                   {kGrass}, {tests::Body(body)}),
                      renderer::sampling_for(8.0), kHeight_m);
  };
  const renderer::Frame expected = picture(clean), frame = picture(dirty);
  CHECK(std::memcmp(frame.bscope_W.data(), expected.bscope_W.data(),
                    frame.bscope_W.size() * sizeof(double)) == 0);
  CHECK(std::memcmp(frame.cscope_W_m3.data(), expected.cscope_W_m3.data(),
                    frame.cscope_W_m3.size() * sizeof(double)) == 0);
}

TEST_CASE("R05: slices see the ground of a ball to its horizon at 31 927.474 m, and nothing behind",
          "[closed_terrain][profile]") {
  constexpr double kRadius_m = 4.0 / 3.0 * 6371000.0;
  constexpr double kHorizon_m = 31927.474;
  // A row of posts stands where the tangent touches; on both sides of it the ground is lower.
  const double tangent_m = std::sqrt((2.0 * kRadius_m + kHeight_m) * kHeight_m);
  CHECK(tangent_m == Approx(kHorizon_m).margin(1e-3).epsilon(0.0));
  const double touches_m = tangent_m * kRadius_m / (kRadius_m + kHeight_m);
  constexpr double kSpacing_m = 20.0;
  terrain::HeightField ball = terrain::make_height_field(
      -1000.0, touches_m - 1600.0 * kSpacing_m, 1000.0, touches_m + 10.0 * kSpacing_m, kSpacing_m);
  for (int j = 0; j < ball.rows; ++j)
    for (int i = 0; i < ball.columns; ++i) {
      const double x_m = ball.west_m + kSpacing_m * i, y_m = ball.south_m + kSpacing_m * j;
      const double square_m2 = x_m * x_m + y_m * y_m;
      ball.height_m[ball.post(i, j)] =
          -square_m2 / (kRadius_m + std::sqrt(kRadius_m * kRadius_m - square_m2));
    }
  sensors::Sensor sensor = tests::even_hivision(1);
  sensor.range.minimum_m = kHorizon_m - 0.2;
  sensor.range.cell_m = 0.01;
  sensor.range.cells = 40;
  const renderer::World world = tests::world(sensor, std::move(ball), {tests::kGamma});
  const renderer::FanSums sums =
      tests::cast_profile(world, 1, tests::level_antenna({0.0, 0.0, kHeight_m}));
  int ahead = 0;
  for (int sub = 1; sub < sums.sub_columns; ++sub)
    if (std::abs(tests::slice_azimuth_rad(sums, sub)) <
        std::abs(tests::slice_azimuth_rad(sums, ahead)))
      ahead = sub;
  REQUIRE(std::abs(tests::slice_azimuth_rad(sums, ahead)) < 1e-9);
  for (int k = 0; k < sensor.range.cells; ++k) {
    INFO("cell " << k);
    const double power_W = sums.range_W_per_rad[static_cast<std::size_t>(ahead * sums.cells + k)];
    if (k < 19) CHECK(power_W > 0.0);
    if (k > 21) CHECK(power_W == 0.0);
  }
}

TEST_CASE("R13: closed ground shows no sky below the horizon, whatever the rays run into",
          "[closed_terrain]") {
  // Every post at a height of its own, too low to throw a shadow on the next.
  std::uint64_t post = 0;
  const renderer::World world =
      tests::world(tests::hivision(24),
                   tests::ground(4000.0, 10.0,
                                 [&](double, double) { return 0.02 * tests::uniform(13, ++post); }),
                   {kGrass});
  const sensors::Sensor& sensor = world.sensor;
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const sensors::Display& display = sensor.display;
  // Low enough for the elevation beam to reach the first range cell.
  for (const double height_m : {60.0, 61.3, 63.9, 66.0}) {
    for (const double rays_per_cell : {1.0, 4.0}) {
      renderer::FramePose pose = tests::level_pose(height_m);
      pose.position_m.x = 5.0;  // along a diagonal's and a column's posts
      const renderer::Frame frame =
          renderer::render_frame(world, renderer::sampling_for(rays_per_cell), {}, {}, pose);
      int sky = 0;
      for (const double power_W : frame.bscope_W) sky += power_W > 0.0 ? 0 : 1;
      // Rows between the first range cell and the last.
      for (int row = 0; row < display.cscope_rows; ++row) {
        const double depression_rad =
            (row + 0.5) * display.cscope_span_rad / display.cscope_rows - display.cscope_top_rad;
        if (depression_rad < std::asin(height_m / sensor.range.maximum_m()) + 5e-4 ||
            depression_rad > std::asin(std::min(height_m / sensor.range.minimum_m, 1.0)) - 5e-4)
          continue;
        for (std::size_t column = 0; column < columns; ++column)
          sky += frame.cscope_W_m3[static_cast<std::size_t>(row) * columns + column] > 0.0 ? 0 : 1;
      }
      INFO("height " << height_m << " m, " << rays_per_cell << " rays per cell");
      CHECK(sky == 0);
    }
  }
}
