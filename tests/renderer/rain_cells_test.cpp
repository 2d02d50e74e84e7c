// Rain cells in the picture: the ray pass and the point targets.
#include "atmosphere/precipitation/rain_cells.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "atmosphere/weather.h"
#include "renderer/stages/point_targets.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/cells.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

renderer::World flat_world(const sensors::Sensor& sensor) {
  return tests::world(sensor, tests::ground(5000.0, 50.0, [](double, double) { return 0.0; }),
                      {materials::PhongNrcs(0.01, 0.0, 1.0)});
}

// A wall of rain across the view from 1000 to 1600 m north, wider than the beam.
atmosphere::Weather shower(double rate_mm_per_h) {
  atmosphere::Weather weather;
  weather.simulate_gas = false;
  atmosphere::RainCell cell;
  cell.centre_m = {0.0, 1300.0};
  cell.length_m = 600.0;
  cell.width_m = 9000.0;
  cell.rain_rate_mm_per_h = rate_mm_per_h;
  weather.rain_cells = {cell};
  return weather;
}

renderer::Frame frame_of(const renderer::World& world) {
  return renderer::render_frame(world, renderer::Sampling{}, {}, {}, tests::level_pose(150.0));
}

}  // namespace

TEST_CASE("Ground behind a rain cell loses its chord, ground before it nothing", "[rain_cells]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const renderer::World clear = flat_world(sensor);
  renderer::World wet = flat_world(sensor);
  const atmosphere::Weather weather = shower(20.0);
  wet.rain_cells = atmosphere::RainCells(weather, 35e9);
  const renderer::Frame without = frame_of(clear);
  const renderer::Frame with = frame_of(wet);
  const double per_km = rain_dB_per_km(weather, 20.0, 35e9);
  const int column = 4;
  int checked = 0;
  for (int cell = 20; cell < sensor.range.cells - 2; ++cell) {
    const auto index = static_cast<std::size_t>(cell * 8 + column);
    if (!(without.bscope_W[index] > 0.0)) continue;
    const double range_m = sensors::range_middle_m(sensor.range, cell);
    const double level_m = std::sqrt(range_m * range_m - 150.0 * 150.0);
    const double loss_dB = -10.0 * std::log10(with.bscope_W[index] / without.bscope_W[index]);
    const double chord_m = std::clamp(level_m - 1000.0, 0.0, 600.0) * range_m / level_m;
    // The beam is up to 1.25 deg wide: the wall is crossed at a slant of cos, 2.4e-4 of the chord;
    // a cell of 6.67 m holds a change of 0.05 dB.
    CHECK(loss_dB == Approx(2e-3 * per_km * chord_m).epsilon(0.0).margin(0.03));
    ++checked;
  }
  CHECK(checked > 400);
}

TEST_CASE("A cell without rain, and rain far from the view, change no byte", "[rain_cells]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const renderer::World clear = flat_world(sensor);
  renderer::World far = flat_world(sensor);
  atmosphere::Weather weather = shower(50.0);
  weather.rain_cells[0].centre_m = {0.0, -20000.0};
  far.rain_cells = atmosphere::RainCells(weather, 35e9);
  renderer::World dry = flat_world(sensor);
  dry.rain_cells = atmosphere::RainCells(shower(0.0), 35e9);
  const renderer::Frame reference = frame_of(clear);
  CHECK(frame_of(far).bscope_W == reference.bscope_W);
  CHECK(frame_of(dry).bscope_W == reference.bscope_W);
  CHECK(frame_of(dry).cscope_W_m3 == reference.cscope_W_m3);
}

TEST_CASE("A06 more rain in a cell makes no ground brighter", "[rain_cells][A06]") {
  const sensors::Sensor sensor = tests::hivision(4);
  renderer::World world = flat_world(sensor);
  std::vector<double> before = frame_of(world).bscope_W;
  for (int step = 1; step <= 20; ++step) {
    world.rain_cells = atmosphere::RainCells(shower(7.5 * step), 35e9);
    const std::vector<double> now = frame_of(world).bscope_W;
    for (std::size_t i = 0; i < now.size(); ++i) REQUIRE(now[i] <= before[i]);
    before = now;
  }
}

TEST_CASE("Point targets lose what lies between", "[rain_cells]") {
  const sensors::Sensor sensor = tests::hivision(8);
  renderer::World world = flat_world(sensor);
  renderer::PointTarget target;
  target.rcs = materials::ConstantRcs{10.0};
  target.path = {{0.0, {0.0, 2000.0, 20.0}}};
  world.targets = {target};
  const renderer::FramePose pose = tests::level_pose(150.0);
  const sensors::AntennaFrame antenna = sensors::antenna_frame(
      pose.position_m, pose.north_east_down, pose.q_NB, sensor.mounting, sensor.scan.stabilised);
  const auto clear = renderer::point_echoes(world, antenna, 0.0);
  const atmosphere::Weather weather = shower(20.0);
  world.rain_cells = atmosphere::RainCells(weather, 35e9);
  const auto wet = renderer::point_echoes(world, antenna, 0.0);
  REQUIRE(clear.size() == 1);
  REQUIRE(wet.size() == 1);
  const double range_m = std::sqrt(2000.0 * 2000.0 + 130.0 * 130.0);
  const double loss_dB = 2e-3 * rain_dB_per_km(weather, 20.0, 35e9) * 600.0 * range_m / 2000.0;
  CHECK(wet[0].power_W / clear[0].power_W == Approx(std::pow(10.0, -0.1 * loss_dB)).epsilon(1e-9));
}
