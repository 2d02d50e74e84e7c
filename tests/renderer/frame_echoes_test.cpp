// Scatterers of a frame against the power picture of the same frame, and against kinematics.
#include "renderer/stages/frame_echoes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numeric>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "renderer/casting/ray_caster.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

const materials::PhongNrcs kStreetGrass(0.02, 0.1, 4.0);

// Level grass with a building that hides some of it.
renderer::World street(int columns) {
  return tests::world(tests::hivision(columns),
                      tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                      {kStreetGrass, materials::PhongNrcs(0.3, 0.0, 1.0)},
                      {tests::box({-60.0, 900.0, 0.0}, {20.0, 940.0, 40.0}, 1)});
}

renderer::FrameEchoSettings fine(int passes) {
  renderer::FrameEchoSettings settings;
  settings.sampling.sub_columns = 4;
  settings.sampling.rays_per_cell = 2.0;
  settings.passes = passes;
  return settings;
}

// Power of every range cell over the field of view, at azimuth gain 1.
std::vector<double> picture_W(const renderer::World& world, const renderer::FramePose& pose) {
  const sensors::Sensor& sensor = world.sensor;
  const auto antenna = sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB,
                                              sensor.mounting, sensor.scan.stabilised);
  renderer::FanSums sums;
  renderer::RayCaster(world, renderer::reference_sampling(3)).cast(antenna, false, sums);
  std::vector<double> cells(static_cast<std::size_t>(sums.cells), 0.0);
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double centre_rad = sums.first_azimuth_rad + (sub + 0.5) * sums.step_rad;
    if (std::abs(centre_rad) > sensor.scan.field_of_view_rad / 2) continue;
    for (int cell = 0; cell < sums.cells; ++cell)
      cells[static_cast<std::size_t>(cell)] +=
          sums.range_W_per_rad[static_cast<std::size_t>(sub * sums.cells + cell)] * sums.step_rad;
  }
  return cells;
}

std::vector<double> echoes_W(const renderer::World& world, const renderer::FrameEchoes& found) {
  const sensors::RangeGate& gate = world.sensor.range;
  std::vector<double> cells(static_cast<std::size_t>(gate.cells), 0.0);
  for (const core::Echo& echo : found.echoes) {
    if (std::abs(echo.azimuth_rad) > world.sensor.scan.field_of_view_rad / 2) continue;
    cells.at(static_cast<std::size_t>((echo.range_m - gate.minimum_m) / gate.cell_m)) +=
        echo.power_W;
  }
  return cells;
}

}  // namespace

TEST_CASE("Echoes of a frame add up to the power picture, cell by cell", "[frame_echoes]") {
  const renderer::World world = street(16);
  const renderer::FramePose pose = tests::level_pose(kHeight_m);
  const std::vector<double> expected = picture_W(world, pose);
  const renderer::FrameEchoes found = renderer::frame_echoes(world, pose, fine(16));
  const std::vector<double> cells = echoes_W(world, found);
  REQUIRE(found.first_target == found.echoes.size());
  CHECK(found.phase_rad.size() == found.echoes.size());
  // 64 sub-columns x 2 cuts x 16 rays a cell: 1/sqrt(2048) is 2.2 % of what varies inside a cell.
  double square = 0.0, largest = 0.0;
  int lit = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (!(expected[cell] > 0.0)) {
      CHECK(cells[cell] == 0.0);
      continue;
    }
    const double error = cells[cell] / expected[cell] - 1.0;
    square += error * error;
    largest = std::max(largest, std::abs(error));
    ++lit;
  }
  INFO("rms " << std::sqrt(square / lit) << ", largest " << largest << ", cells " << lit);
  CHECK(lit > 400);
  CHECK(std::sqrt(square / lit) < 0.03);
  CHECK(largest < 0.15);
  const double sum = std::accumulate(cells.begin(), cells.end(), 0.0);
  CHECK(sum == Approx(std::accumulate(expected.begin(), expected.end(), 0.0)).epsilon(0.005));
}

TEST_CASE("Phases of echoes make fully developed speckle and are drawn per frame",
          "[frame_echoes]") {
  const renderer::World world = street(16);
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  std::vector<double> intensities;  // over their mean
  for (std::uint32_t index = 0; index < 8; ++index) {
    pose.frame_index = index;
    const renderer::FrameEchoes found = renderer::frame_echoes(world, pose, fine(1));
    const sensors::RangeGate& gate = world.sensor.range;
    std::vector<std::complex<double>> sums(static_cast<std::size_t>(gate.cells));
    std::vector<double> powers(sums.size(), 0.0);
    for (std::size_t i = 0; i < found.echoes.size(); ++i) {
      const core::Echo& echo = found.echoes[i];
      const auto cell = static_cast<std::size_t>((echo.range_m - gate.minimum_m) / gate.cell_m);
      sums[cell] += std::polar(std::sqrt(echo.power_W), found.phase_rad[i]);
      powers[cell] += echo.power_W;
    }
    for (std::size_t cell = 0; cell < sums.size(); ++cell)
      if (powers[cell] > 0.0) intensities.push_back(std::norm(sums[cell]) / powers[cell]);
  }
  // Exponential: mean 1, mean square 2, each within four standard deviations.
  const double count = static_cast<double>(intensities.size());
  double mean = 0.0, square = 0.0;
  for (const double intensity : intensities) {
    mean += intensity / count;
    square += intensity * intensity / count;
  }
  CHECK(count > 3000);
  CHECK(mean == Approx(1.0).epsilon(0.0).margin(4.0 / std::sqrt(count)));
  CHECK(square == Approx(2.0).epsilon(0.0).margin(4.0 * std::sqrt(20.0 / count)));
}

TEST_CASE("Radial speeds of echoes are those of kinematics", "[frame_echoes]") {
  renderer::World world = street(16);
  // Drives north-east from (0, 1000) at 10 m/s each way, and stands from 5 s on.
  world.targets.push_back({"car",
                           materials::ConstantRcs{100.0},
                           {{0.0, {0.0, 1000.0, 50.0}}, {5.0, {50.0, 1050.0, 50.0}}}});
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  renderer::FrameEchoSettings settings = fine(1);
  settings.own_velocity_mps = {0.0, 70.0, -3.0};
  pose.time_s = 0.0;
  const renderer::FrameEchoes found = renderer::frame_echoes(world, pose, settings);
  double worst_mps = 0.0;
  for (std::size_t i = 0; i < found.first_target; ++i) {
    const core::Echo& echo = found.echoes[i];
    const double expected_mps = -70.0 * std::cos(echo.elevation_rad) * std::cos(echo.azimuth_rad) +
                                3.0 * std::sin(echo.elevation_rad);
    worst_mps = std::max(worst_mps, std::abs(echo.radial_speed_mps - expected_mps));
  }
  CHECK(found.first_target > 10'000);
  CHECK(worst_mps < 1e-4);  // directions are floats
  REQUIRE(found.echoes.size() == found.first_target + 1);
  const double range_m = std::hypot(1000.0, 10.0);
  CHECK(found.echoes.back().range_m == Approx(range_m));
  // (10, 10, 0) less (0, 70, -3) along (0, 1000, -10).
  CHECK(found.echoes.back().radial_speed_mps ==
        Approx((-60.0 * 1000.0 + 3.0 * -10.0) / range_m).epsilon(1e-12));
  CHECK(world.targets[0].velocity_at(4.999) == glm::dvec3(10.0, 10.0, 0.0));
  CHECK(world.targets[0].velocity_at(5.0) == glm::dvec3(0.0));
  CHECK(world.targets[0].velocity_at(-0.001) == glm::dvec3(0.0));
}

TEST_CASE("Looks of a frame share the draw of Swerling 1 and 3, and have their own of 2 and 4",
          "[frame_echoes]") {
  renderer::World world = street(16);
  for (const auto which :
       {core::Swerling::case1, core::Swerling::case2, core::Swerling::case3, core::Swerling::case4})
    world.targets.push_back({.name = "mast",
                             .rcs = materials::ConstantRcs{100.0},
                             .path = {{0.0, {0.0, 1000.0, 50.0}}},
                             .swerling = which});
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  renderer::FrameEchoSettings settings = fine(1);
  settings.swerling = true;
  const renderer::FrameEchoes first = renderer::frame_echoes(world, pose, settings);
  settings.look = 1;
  const renderer::FrameEchoes second = renderer::frame_echoes(world, pose, settings);
  pose.frame_index = 1;
  const renderer::FrameEchoes next = renderer::frame_echoes(world, pose, settings);
  REQUIRE(first.echoes.size() - first.first_target == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const double first_W = first.echoes[first.first_target + i].power_W;
    const double second_W = second.echoes[second.first_target + i].power_W;
    CHECK((first_W == second_W) == (i % 2 == 0));
    CHECK(next.echoes[next.first_target + i].power_W != second_W);
    CHECK(first.phase_rad[first.first_target + i] != second.phase_rad[second.first_target + i]);
  }
  CHECK(first.echoes[0].elevation_rad != second.echoes[0].elevation_rad);  // its own places
}

TEST_CASE("Echoes of a frame do not depend on threads, and differ from frame to frame",
          "[frame_echoes]") {
  const renderer::World world = street(8);
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  const renderer::FrameEchoes many = renderer::frame_echoes(world, pose, fine(2));
  renderer::FrameEchoes one;
  {
    const core::ThreadLimit single(1);
    one = renderer::frame_echoes(world, pose, fine(2));
  }
  REQUIRE(one.echoes.size() == many.echoes.size());
  bool equal = one.phase_rad == many.phase_rad;
  for (std::size_t i = 0; i < one.echoes.size(); ++i)
    equal = equal && one.echoes[i].range_m == many.echoes[i].range_m &&
            one.echoes[i].power_W == many.echoes[i].power_W;
  CHECK(equal);
  pose.frame_index = 1;
  CHECK(renderer::frame_echoes(world, pose, fine(2)).phase_rad != many.phase_rad);
  renderer::FrameEchoSettings other = fine(2);
  other.seed = 1;
  CHECK(renderer::frame_echoes(world, pose, other).phase_rad != many.phase_rad);

  other.own_velocity_mps.x = std::nan("");
  CHECK_THROWS_AS(renderer::frame_echoes(world, pose, other), core::InputError);
  other = fine(0);
  CHECK_THROWS_AS(renderer::frame_echoes(world, pose, other), core::InputError);
  other = fine(1);
  other.half_fan_rad = 4.0;
  CHECK_THROWS_AS(renderer::frame_echoes(world, pose, other), core::InputError);
  // Hundreds of gigabytes of echoes: refused before any ray is cast.
  other = fine(64);
  other.sampling.rays_per_cell = 1e5;
  CHECK_THROWS_WITH(renderer::frame_echoes(world, pose, other), Catch::Contains("E-LIMIT"));
}

TEST_CASE("The limit on rays counts both ways of an antenna that looks down", "[frame_echoes]") {
  renderer::World world = street(8);
  world.sensor.scan.stabilised = false;
  renderer::FrameEchoSettings settings = fine(1);
  settings.half_fan_rad = world.sensor.scan.field_of_view_rad / 2;
  settings.sampling.rays_per_cell =
      0.75 * renderer::kMostFrameEchoRays /
      (world.sensor.range.cells * 8.0 * settings.sampling.sub_columns);
  world.sensor.mounting.pitch_rad = -core::kPi / 2;
  CHECK_THROWS_WITH(renderer::frame_echoes(world, tests::level_pose(kHeight_m), settings),
                    Catch::Contains("E-LIMIT") && Catch::Contains("rays of a frame"));
}

TEST_CASE("A scan all round has scatterers behind it as many as ahead", "[frame_echoes]") {
  sensors::Sensor sensor = tests::hivision(36);
  sensor.scan.field_of_view_rad = 2.0 * core::kPi;
  const renderer::World world = tests::world(
      sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }), {kStreetGrass});
  renderer::FrameEchoSettings settings = fine(1);
  settings.sampling.sub_columns = 1;
  int ahead = 0, behind = 0;
  for (const core::Echo& echo :
       renderer::frame_echoes(world, tests::level_pose(kHeight_m), settings).echoes)
    ++(std::abs(echo.azimuth_rad) > core::kPi / 2 ? behind : ahead);
  CHECK(ahead > 1000);
  CHECK(behind == Approx(ahead).epsilon(0.1));
}
