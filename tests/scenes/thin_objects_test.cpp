// R09: objects thinner than a ray do not flicker, because they are points along a line.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iostream>
#include <numeric>

#include "core/decibel.h"
#include "core/random.h"
#include "renderer/stages/point_targets.h"
#include "scenes/line_points.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;
using core::kPi;

namespace {

constexpr int kSteps = 1000;
constexpr double kRange_m = 1500.0;
constexpr double kHeight_m = 100.0;  // of the sensor above level ground

// Level ground that returns nothing of its own: it only could hide things.
renderer::World world_with(const scenes::LineDescription& line, const glm::dvec3& begin_m,
                           const glm::dvec3& end_m) {
  renderer::World world = tests::world(
      tests::hivision(48), tests::ground(2500.0, 50.0, [](double, double) { return 0.0; }), {});
  scenes::add_line_points(line, begin_m, end_m, core::Polarisation::horizontal, world.targets);
  return world;
}

sensors::AntennaFrame antenna_at(const glm::dvec3& position_m) {
  return {position_m, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
}

// Received power of everything, summed over the cells of the B-scope.
double summed_W(const renderer::World& world, const glm::dvec3& sensor_m) {
  std::vector<double> bscope_W(
      static_cast<std::size_t>(world.sensor.range.cells * world.sensor.scan.columns));
  std::vector<double> no_cscope;
  renderer::add_echoes(renderer::point_echoes(world, antenna_at(sensor_m), 0.0), world.sensor,
                       bscope_W, no_cscope);
  return std::accumulate(bscope_W.begin(), bscope_W.end(), 0.0);
}

// The radar equation for a cross-section at one place, summed over columns: the trend of R^-4 and
// of the elevation pattern that a step of the sensor brings with it.
double closed_form_W(const sensors::Sensor& sensor, const glm::dvec3& sensor_m,
                     const glm::dvec3& place_m, double rcs_m2) {
  const glm::dvec3 path_m = place_m - sensor_m;
  const double range_m = glm::length(path_m);
  const double elevation_rad = std::asin(path_m.z / range_m);
  const double columns = sensors::two_way_width(sensor.antenna.azimuth) /
                         (sensor.scan.column_width_rad() * std::cos(elevation_rad));
  return sensor.radar_constant_W_m2() * rcs_m2 * columns *
         sensors::two_way_gain(sensor.antenna.elevation,
                               elevation_rad - sensor.antenna.boresight_elevation_rad) /
         std::pow(range_m, 4);
}

// Steps of up to one range cell and one beam width to all sides.
glm::dvec3 random_step_m(const sensors::Sensor& sensor, int step) {
  const auto words = core::random_words({9, 99, 0}, static_cast<std::uint64_t>(step), 0);
  const auto even = [&](std::size_t i) { return 2.0 * core::uniform_from(words[i]) - 1.0; };
  const double beam_m = kRange_m * sensor.antenna.azimuth.half_power_width_rad;
  return {even(0) * beam_m, even(1) * sensor.range.cell_m, even(2) * sensor.range.cell_m};
}

struct Steadiness {
  double mean_dB = 0.0, peak_to_peak_dB = 0.0;
};

// Of the summed power over its closed form.
Steadiness steadiness(const renderer::World& world, const char* name,
                      const std::function<double(const glm::dvec3&)>& expected_W) {
  double low_dB = 1e9, high_dB = -1e9, sum = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const glm::dvec3 sensor_m = glm::dvec3(0.0, 0.0, kHeight_m) + random_step_m(world.sensor, step);
    const double ratio = summed_W(world, sensor_m) / expected_W(sensor_m);
    low_dB = std::min(low_dB, 10.0 * std::log10(ratio));
    high_dB = std::max(high_dB, 10.0 * std::log10(ratio));
    sum += ratio;
  }
  const Steadiness result{10.0 * std::log10(sum / kSteps), high_dB - low_dB};
  std::cout << "R09 " << name << ": mean " << result.mean_dB << " dB, peak to peak "
            << result.peak_to_peak_dB << " dB\n";
  return result;
}

}  // namespace

TEST_CASE("R09 a 0.3 m pole at 1500 m is steady and has its closed-form cross-section", "[R09]") {
  scenes::LineDescription line;
  line.name = "pole";
  // pi r / W with W = 10 deg: docs/physics/thin-objects.md.
  line.rcs_m2_per_m = kPi * 0.15 / core::radians(10.0);
  const glm::dvec3 foot_m(0.0, kRange_m, 0.0);
  const glm::dvec3 top_m(0.0, kRange_m, 12.0);
  const renderer::World world = world_with(line, foot_m, top_m);
  const Steadiness pole = steadiness(world, "pole", [&](const glm::dvec3& sensor_m) {
    return closed_form_W(world.sensor, sensor_m, 0.5 * (foot_m + top_m), 12.0 * line.rcs_m2_per_m);
  });
  CHECK(pole.peak_to_peak_dB < 0.1);
  CHECK(std::abs(pole.mean_dB) < 0.5);
}

TEST_CASE("R09 a 20 mm wire with an even cross-section is steady at 1500 m", "[R09]") {
  scenes::LineDescription line;
  line.name = "wire";
  line.rcs_m2_per_m = 0.03;
  const glm::dvec3 west_m(-100.0, kRange_m, 24.0);
  const glm::dvec3 east_m(100.0, kRange_m, 24.0);
  const renderer::World world = world_with(line, west_m, east_m);
  const Steadiness wire = steadiness(world, "even wire", [&](const glm::dvec3& sensor_m) {
    constexpr int kPieces = 4000;  // much finer than the points
    double sum_W = 0.0;
    for (int i = 0; i < kPieces; ++i)
      sum_W +=
          closed_form_W(world.sensor, sensor_m, west_m + (east_m - west_m) * ((i + 0.5) / kPieces),
                        line.rcs_m2_per_m * 200.0 / kPieces);
    return sum_W;
  });
  CHECK(wire.peak_to_peak_dB < 0.1);
  CHECK(std::abs(wire.mean_dB) < 0.5);
}

TEST_CASE("R09 a 20 mm wire flashes steadily at 1500 m with pi a R whatever it is cut into",
          "[R09]") {
  // A long conductor at broadside, geometrical optics with a spherical wave: pi a R.
  const glm::dvec3 west_m(-100.0, kRange_m, 24.0);
  const glm::dvec3 east_m(100.0, kRange_m, 24.0);
  for (const double spacing_m : {0.5, 1.0, 2.0}) {
    scenes::LineDescription line;
    line.name = "wire";
    line.spacing_m = spacing_m;
    line.wire.emplace();
    const renderer::World world = world_with(line, west_m, east_m);
    const std::string name = "wire in pieces of " + core::number_text(spacing_m) + " m";
    const Steadiness wire = steadiness(world, name.c_str(), [&](const glm::dvec3& sensor_m) {
      const glm::dvec3 nearest_m(sensor_m.x, kRange_m, 24.0);
      return closed_form_W(world.sensor, sensor_m, nearest_m,
                           kPi * 0.01 * glm::length(nearest_m - sensor_m));
    });
    CHECK(wire.peak_to_peak_dB < 0.1);
    CHECK(std::abs(wire.mean_dB) < 0.5);
  }
}

TEST_CASE("R09 pieces too long for their distance flicker: 2 c spacing / lambda is the limit",
          "[R09]") {
  scenes::LineDescription line;
  line.name = "wire";
  line.spacing_m = 8.0;  // far field from 15 km
  line.wire.emplace();
  const glm::dvec3 west_m(-100.0, kRange_m, 24.0);
  const glm::dvec3 east_m(100.0, kRange_m, 24.0);
  const renderer::World world = world_with(line, west_m, east_m);
  const Steadiness wire =
      steadiness(world, "wire in pieces of 8 m", [&](const glm::dvec3& sensor_m) {
        const glm::dvec3 nearest_m(sensor_m.x, kRange_m, 24.0);
        return closed_form_W(world.sensor, sensor_m, nearest_m, kPi * 0.01 * kRange_m);
      });
  CHECK(wire.peak_to_peak_dB > 3.0);
}
