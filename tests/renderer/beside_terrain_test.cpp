// An antenna beside the ground's tile, looking at it.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/pose.h"
#include "renderer/accuracy/grey_error.h"
#include "tests/renderer/city_world.h"

using namespace fanbeam;
using tests::kGrass;

namespace {

// The tile begins 300 m north of the antenna.
terrain::HeightField tile(const std::function<double(double, double)>& height_m) {
  terrain::HeightField field = terrain::make_height_field(-1500.0, 300.0, 1500.0, 3300.0, 30.0);
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i)
      field.height_m[field.post(i, j)] =
          height_m(field.west_m + field.spacing_m * i, field.south_m + field.spacing_m * j);
  return field;
}

renderer::World level_tile(const sensors::Sensor& sensor, double height_m) {
  return tests::world(sensor, tile([height_m](double, double) { return height_m; }), {kGrass});
}

renderer::Frame frame_of(const renderer::World& world, const renderer::Sampling& sampling,
                         double height_m) {
  return renderer::render_frame(world, sampling, {}, {{core::EffectId::thermal_noise}},
                                tests::level_pose(height_m));
}

// Of a row, over all columns.
double row_W(const renderer::World& world, const renderer::Frame& frame, int row) {
  const auto first =
      frame.bscope_W.begin() + static_cast<std::ptrdiff_t>(row) * world.sensor.scan.columns;
  return std::accumulate(first, first + world.sensor.scan.columns, 0.0);
}

}  // namespace

TEST_CASE("An antenna beside the ground's tile sees it by rays as by slices", "[beside_terrain]") {
  const renderer::World world = level_tile(tests::hivision(12), 0.0);
  const renderer::Frame rays = frame_of(world, renderer::sampling_for(16.0), 60.0);
  const renderer::Frame slices = frame_of(world, renderer::profile_sampling_for(16.0), 60.0);
  const sensors::RangeGate& gate = world.sensor.range;
  int lit = 0;
  for (int row = 0; row < gate.cells; ++row) {
    const double range_m = gate.minimum_m + gate.cell_m * (row + 0.5);
    if (range_m < 312.0 || range_m > 3200.0) continue;
    INFO("range " << range_m << " m");
    REQUIRE(row_W(world, slices, row) > 0.0);
    REQUIRE(row_W(world, rays, row) / row_W(world, slices, row) ==
            Approx(1.0).epsilon(0.0).margin(0.02));
    ++lit;
  }
  CHECK(lit > 100);
  CHECK(rays.events.empty());
}

TEST_CASE("Beyond its rim a tile looks as the ground that goes on to the antenna",
          "[beside_terrain]") {
  // Falls away from the antenna and across the fan: the rim is nearer to it than what lies behind.
  const auto height_m = [](double x_m, double y_m) {
    return -0.05 * (y_m - 300.0) - 0.03 * x_m + 2.0 * std::sin(x_m / 90.0);
  };
  const auto surface = GENERATE(sensors::ScanSurface::plane, sensors::ScanSurface::cone);
  const double roll_deg = GENERATE(0.0, 10.0);
  const auto sampling = GENERATE(renderer::sampling_for(64.0), renderer::profile_sampling_for(8.0));
  sensors::Sensor sensor = tests::hivision(40);
  sensor.scan.surface = surface;
  sensor.scan.stabilised = false;
  renderer::FramePose pose = tests::level_pose(80.0);
  pose.q_NB = core::quaternion_from({core::radians(roll_deg), 0.0, 0.0});
  const auto seen = [&](terrain::HeightField field) {
    const renderer::World world = tests::world(sensor, std::move(field), {kGrass});
    return renderer::render_frame(world, sampling, {}, {}, pose).bscope_W;
  };
  const std::vector<double> beside = seen(tile(height_m));
  const std::vector<double> above = seen(tests::ground(3300.0, 30.0, height_m));
  INFO("cone " << (surface == sensors::ScanSurface::cone) << ", roll " << roll_deg
               << " deg, slices " << (sampling.caster == renderer::CasterKind::profile));
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  int compared = 0, apart = 0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double range_m = sensor.range.minimum_m + sensor.range.cell_m * (row + 0.5);
    if (range_m < 420.0 || range_m > 2800.0) continue;  // the rim is farther away aside
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * columns + column;
      ++compared;
      if (!(std::abs(beside[i] / above[i] - 1.0) < 0.05)) ++apart;
    }
  }
  CHECK(compared > 10000);
  CHECK(apart < compared / 100);
}

TEST_CASE("Height above ground beside the tile is that above its border", "[beside_terrain]") {
  sensors::Sensor sensor = tests::hivision(12);
  sensor.display.cscope_mode = sensors::Display::CScopeMode::flat_earth;
  const renderer::Frame low =
      frame_of(level_tile(sensor, 0.0), renderer::profile_sampling_for(4.0), 60.0);
  const renderer::Frame high =
      frame_of(level_tile(sensor, 512.0), renderer::profile_sampling_for(4.0), 572.0);
  double brightest = 0.0;
  for (std::size_t i = 0; i < low.cscope_grey.size(); ++i) {
    REQUIRE(high.cscope_grey[i] == Approx(low.cscope_grey[i]).epsilon(0.0).margin(0.1));
    brightest = std::max(brightest, low.cscope_grey[i]);
  }
  CHECK(brightest > 50.0);
}

TEST_CASE("A C-scope drawn from the B-scope holds its noise once", "[beside_terrain]") {
  for (const auto mode :
       {sensors::Display::CScopeMode::true_elevation, sensors::Display::CScopeMode::shadow,
        sensors::Display::CScopeMode::flat_earth}) {
    sensors::Sensor sensor = tests::hivision(12);
    sensor.display.cscope_mode = mode;
    const renderer::World world = level_tile(sensor, 0.0);
    const renderer::Frame frame = frame_of(world, renderer::profile_sampling_for(2.0), 60.0);
    const renderer::FrameGrey shown =
        renderer::grey_of(sensor, {frame.bscope_W, frame.cscope_W_m3}, true);
    INFO("mode " << static_cast<int>(mode));
    CHECK(shown.bscope == frame.bscope_grey);
    CHECK(shown.cscope == frame.cscope_grey);
  }
}
