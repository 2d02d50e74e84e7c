// What walls and towers do to a B-scope, as numbers.
#include <catch2/catch.hpp>

#include "core/pose.h"
#include "core/units.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;
using tests::kHeight_m;
using tests::kWall;

namespace {

terrain::HeightField fine_plane() {
  return tests::ground(4000.0, 100.0, [](double, double) { return 0.0; });
}

// Middle column's power per cell.
std::vector<double> middle_column(const renderer::World& world, double rays_per_cell = 64.0) {
  const renderer::Frame frame =
      renderer::render_frame(world, renderer::sampling_for(rays_per_cell), {true, false}, {},
                             tests::level_pose(kHeight_m));
  std::vector<double> power_W;
  for (int k = 0; k < world.sensor.range.cells; ++k)
    power_W.push_back(frame.bscope_W[static_cast<std::size_t>(k * world.sensor.scan.columns +
                                                              world.sensor.scan.columns / 2)]);
  return power_W;
}

int cell_of(const sensors::Sensor& sensor, double range_m) {
  return static_cast<int>((range_m - sensor.range.minimum_m) / sensor.range.cell_m);
}

}  // namespace

TEST_CASE("The radar shadow of a wall ends where the line over its top meets the ground",
          "[geometry]") {
  constexpr double kWall_m = 1000.0, kTop_m = 20.0;
  const renderer::World world =
      tests::world(tests::hivision(12), fine_plane(), {kGrass, kWall},
                   {tests::box({-300.0, kWall_m, -1.0}, {300.0, kWall_m + 1.0, kTop_m}, 1)});
  const renderer::World open = tests::world(tests::hivision(12), fine_plane(), {kGrass});
  const std::vector<double> with = middle_column(world);
  const std::vector<double> without = middle_column(open);
  // Similar triangles from the far upper edge: ground distance (y + 1) h / (h - top).
  const double end_m = std::hypot((kWall_m + 1.0) * kHeight_m / (kHeight_m - kTop_m), kHeight_m);
  const int wall = cell_of(world.sensor, std::hypot(kWall_m, kHeight_m - kTop_m));
  const int end = cell_of(world.sensor, end_m);
  for (int k = wall + 3; k < end - 1; ++k) REQUIRE(with[static_cast<std::size_t>(k)] == 0.0);
  for (int k = end + 2; k < world.sensor.range.cells; ++k)
    REQUIRE(10.0 * std::log10(with[static_cast<std::size_t>(k)] /
                              without[static_cast<std::size_t>(k)]) ==
            Approx(0.0).epsilon(0.0).margin(0.3));
  for (int k = 0; k < wall - 1; ++k)
    REQUIRE(10.0 * std::log10(with[static_cast<std::size_t>(k)] /
                              without[static_cast<std::size_t>(k)]) ==
            Approx(0.0).epsilon(0.0).margin(0.3));
  // The wall itself, a face across the beam, is far brighter than grass at 3.4 deg.
  CHECK(with[static_cast<std::size_t>(wall)] > 30.0 * without[static_cast<std::size_t>(wall)]);
}

TEST_CASE("A tower lies over: its top is nearer than its foot", "[geometry]") {
  // Sensor 60 m high, tower 40 m tall at 400 m: the foot's slant range is sqrt(400^2 + 60^2) =
  // 404.5 m, the top's sqrt(400^2 + 20^2) = 400.5 m; with a 2 m cell the two are two cells apart.
  sensors::Sensor sensor = tests::hivision(12);
  sensor.range.cell_m = 1.0;
  sensor.range.cells = 400;
  const renderer::World world =
      tests::world(sensor, fine_plane(), {kGrass, kWall},
                   {tests::box({-30.0, 400.0, 0.0}, {30.0, 401.0, 40.0}, 1)});
  const renderer::World open = tests::world(sensor, fine_plane(), {kGrass});
  const std::vector<double> with = middle_column(world, 200.0);
  const std::vector<double> without = middle_column(open, 200.0);
  const auto ratio_dB = [&](double range_m) {
    const auto k = static_cast<std::size_t>(cell_of(sensor, range_m));
    return 10.0 * std::log10(with[k] / without[k]);
  };
  CHECK(ratio_dB(399.5) < 1.0);
  for (const double range_m : {400.6, 401.5, 402.5, 403.5, 404.2}) CHECK(ratio_dB(range_m) > 6.0);
}

TEST_CASE("A rolled, pitched and unstabilised antenna sees the same ground", "[geometry]") {
  // Total power from level ground in a wide window hardly depends on roll; range cells of the
  // middle column do not move.
  sensors::Sensor sensor = tests::hivision(24);
  sensor.scan.stabilised = false;
  for (const sensors::ScanSurface surface :
       {sensors::ScanSurface::plane, sensors::ScanSurface::cone}) {
    sensor.scan.surface = surface;
    const renderer::World world = tests::world(sensor, fine_plane(), {kGrass});
    renderer::FramePose pose = tests::level_pose(kHeight_m);
    pose.q_NB = core::quaternion_from({core::radians(10.0), core::radians(-5.0), 0.0});
    const renderer::Frame coarse =
        renderer::render_frame(world, renderer::sampling_for(16.0), {true, false}, {}, pose);
    renderer::Sampling fine = renderer::sampling_for(400.0);
    fine.largest_step_rad = 2e-4;
    const renderer::Frame dense = renderer::render_frame(world, fine, {true, false}, {}, pose);
    double worst_dB = 0.0;
    for (std::size_t i = 0; i < coarse.bscope_W.size(); ++i) {
      // Below the noise lie the cells that the pattern's cut runs through: nothing of them shows.
      if (dense.bscope_W[i] < sensor.noise_power_W()) continue;
      REQUIRE(coarse.bscope_W[i] > 0.0);
      worst_dB =
          std::max(worst_dB, std::abs(10.0 * std::log10(coarse.bscope_W[i] / dense.bscope_W[i])));
    }
    CHECK(worst_dB < 0.5);
  }
}

TEST_CASE("The C-scope leaves no empty row inside lit ground", "[geometry]") {
  const renderer::World world = tests::world(tests::hivision(8), fine_plane(), {kGrass});
  const renderer::Frame frame = renderer::render_frame(world, renderer::sampling_for(2.0), {}, {},
                                                       tests::level_pose(kHeight_m));
  const sensors::Display& display = world.sensor.display;
  // Ground between the last and the first range cell: depression asin(h / R).
  for (int row = 0; row < display.cscope_rows; ++row) {
    const double elevation_rad =
        display.cscope_top_rad - (row + 0.5) * display.cscope_span_rad / display.cscope_rows;
    const bool ground =
        elevation_rad < -std::asin(kHeight_m / world.sensor.range.maximum_m()) - 5e-4;
    for (int column = 0; column < world.sensor.scan.columns; ++column) {
      const double value =
          frame.cscope_W_m3[static_cast<std::size_t>(row * world.sensor.scan.columns + column)];
      if (ground) REQUIRE(value > 0.0);
      if (elevation_rad > 0.0) REQUIRE(value == 0.0);
    }
  }
}
