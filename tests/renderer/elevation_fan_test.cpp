// Elevations of a fan over level ground, whose every visible range is known.
#include "renderer/casting/elevation_fan.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

// Of one azimuth, or those that share a fan, from `height_m` above a plane, `pitch_rad` nose up.
std::vector<double> edges_of(const sensors::Sensor& sensor, double height_m, double pitch_rad,
                             double azimuth_rad,
                             const renderer::Sampling& sampling = renderer::sampling_for(4.0),
                             double width_rad = 0.0) {
  const renderer::World world =
      tests::world(sensor, tests::ground(9000.0, 100.0, [](double, double) { return 0.0; }),
                   {materials::PhongNrcs(0.1, 0.1, 1.0)});
  renderer::FramePose pose = tests::level_pose(height_m);
  pose.q_NB = pose.q_NB * glm::angleAxis(pitch_rad, glm::dvec3(0.0, 1.0, 0.0));
  std::vector<double> edges;
  const renderer::ElevationFan fan(world, sampling);
  fan.place(renderer::antenna_of(sensor, pose), azimuth_rad - width_rad / 2,
            azimuth_rad + width_rad / 2, edges);
  return edges;
}

// Requires a narrow interval of `edges` around every direction of the beam that meets the plane in the
// gate, but for what is not in the first `share` of it; how many were tried.
int directions_held(const sensors::Sensor& sensor, double height_m, double azimuth_rad,
                    const std::vector<double>& edges, double share = 0.95, double step_rad = 0.01) {
  const sensors::AntennaFrame antenna = renderer::antenna_of(sensor, tests::level_pose(height_m));
  const double reach_rad = sensors::reach_rad(sensor.antenna.elevation) - 1e-3;
  int tried = 0;
  for (double beside_rad = -reach_rad; beside_rad < reach_rad; beside_rad += step_rad) {
    const double elevation_rad = sensor.antenna.boresight_elevation_rad + beside_rad;
    const double down =
        -sensors::direction(antenna, azimuth_rad, elevation_rad, sensor.scan.surface).z;
    if (std::abs(elevation_rad) > core::kPi / 2 || !(down > 0.0)) continue;
    const double range_m = height_m / down;
    if (range_m < sensor.range.minimum_m || range_m >= share * sensor.range.maximum_m()) continue;
    ++tried;
    INFO("elevation " << core::degrees(elevation_rad) << " deg, " << range_m << " m");
    const auto above = std::lower_bound(edges.begin(), edges.end(), elevation_rad);
    REQUIRE(above != edges.begin());
    REQUIRE(above != edges.end());
    CHECK(*above - *(above - 1) <= 3.001e-3);
  }
  return tried;
}

sensors::Sensor turned_sensor(sensors::ScanSurface surface, double roll_deg, double pitch_deg,
                              double boresight_deg) {
  sensors::Sensor sensor = tests::hivision(8);
  sensor.scan.surface = surface;
  sensor.scan.stabilised = false;
  sensor.antenna.boresight_elevation_rad = core::radians(boresight_deg);
  sensor.mounting.roll_rad = core::radians(roll_deg);
  sensor.mounting.pitch_rad = core::radians(pitch_deg);
  return sensor;
}

}  // namespace

TEST_CASE("Fans begin at the ground below and reach the end of the gate", "[elevation_fan]") {
  struct Case {
    sensors::ScanSurface surface;
    double minimum_m, cell_m, height_m, pitch_deg;
  };
  using sensors::ScanSurface;
  const Case cases[] = {{ScanSurface::plane, 200.0, 6.67, 150.0, 0.0},
                        {ScanSurface::plane, 200.0, 6.67, 300.0, -3.0},
                        // Two cells before the first one are behind the antenna.
                        {ScanSurface::plane, 0.0, 25.0, 12.0, 0.0},
                        {ScanSurface::plane, 0.0, 10.0, 0.5, 0.0},
                        // Straight below is behind a lowered nose.
                        {ScanSurface::cone, 200.0, 6.67, 250.0, -5.0},
                        {ScanSurface::cone, 200.0, 6.67, 300.0, -0.5},
                        {ScanSurface::cone, 200.0, 6.67, 300.0, 4.0},
                        {ScanSurface::cone, 0.0, 25.0, 12.0, -5.0}};
  for (const Case& of : cases) {
    sensors::Sensor sensor = tests::hivision(8);
    sensor.scan.surface = of.surface;
    sensor.scan.stabilised = false;
    sensor.range.minimum_m = of.minimum_m;
    sensor.range.cell_m = of.cell_m;
    sensor.range.cells = static_cast<int>(3500.0 / of.cell_m);
    const double pitch_rad = core::radians(of.pitch_deg);
    // A line of the ground in a cone, a curve in a plane.
    const double azimuth_rad = of.surface == ScanSurface::cone ? 0.2 : 0.0;
    const std::vector<double> edges = edges_of(sensor, of.height_m, pitch_rad, azimuth_rad);
    INFO(of.height_m << " m, pitch " << of.pitch_deg << ", from " << of.minimum_m << " m on");
    REQUIRE(edges.size() > 2);
    CHECK(std::is_sorted(edges.begin(), edges.end()));
    const double lowest_rad =
        sensor.antenna.boresight_elevation_rad - sensors::reach_rad(sensor.antenna.elevation);
    const auto elevation_rad = [&](double range_m) {
      return -std::asin(std::min(of.height_m / (range_m * std::cos(azimuth_rad)), 1.0)) - pitch_rad;
    };
    const double nearest_m = std::max(of.minimum_m, of.height_m);
    CHECK(edges.front() <= std::max(elevation_rad(nearest_m), lowest_rad) + 1e-9);
    CHECK(edges.back() >= elevation_rad(sensor.range.maximum_m()));
    // One ray a cell, whichever cell.
    for (double range_m = std::max(1.2 * nearest_m, 400.0); range_m < sensor.range.maximum_m();
         range_m += 300.0) {
      if (elevation_rad(range_m) < lowest_rad) continue;
      const auto inside = [&](double elevation) {
        return std::lower_bound(edges.begin(), edges.end(), elevation) - edges.begin();
      };
      CHECK(inside(elevation_rad(range_m + 4.0 * of.cell_m)) - inside(elevation_rad(range_m)) >= 3);
    }
  }
}

// Of a rolled antenna a column leans: what it meets above the horizon stands beside its foot.
TEST_CASE("Fans of tilted antennas reach to the tops that their azimuths meet", "[elevation_fan]") {
  for (const sensors::ScanSurface surface :
       {sensors::ScanSurface::plane, sensors::ScanSurface::cone}) {
    sensors::Sensor sensor = tests::hivision(164);
    sensor.scan.surface = surface;
    sensor.scan.stabilised = false;
    const renderer::World world =
        tests::world(sensor, tests::ground(4000.0, 100.0, [](double, double) { return 0.0; }),
                     {materials::PhongNrcs(0.1, 0.1, 1.0)},
                     {tests::box({-20.0, 480.0, -2.0}, {40.0, 520.0, 75.0}, 0)});
    const renderer::ElevationFan fan(world, renderer::sampling_for(4.0));
    int above = 0;
    for (const double roll_deg : {-28.0, -6.0, 0.0, 6.0, 28.0}) {
      renderer::FramePose pose = tests::level_pose(60.0);
      pose.q_NB = glm::angleAxis(core::radians(7.0), glm::dvec3(0.0, 1.0, 0.0)) *
                  glm::angleAxis(core::radians(roll_deg), glm::dvec3(1.0, 0.0, 0.0));
      const sensors::AntennaFrame antenna = renderer::antenna_of(sensor, pose);
      for (double azimuth_rad = -0.3; azimuth_rad < 0.3; azimuth_rad += 0.01) {
        double highest_rad = -1.0;
        for (double elevation_rad = -0.3; elevation_rad < 0.2; elevation_rad += 0.001) {
          const glm::dvec3 along = sensors::direction(antenna, azimuth_rad, elevation_rad, surface);
          const auto hit = world.surfaces().intersect(antenna.position_m, along, 3000.0);
          if (hit && along.z > 0.0) highest_rad = elevation_rad;
        }
        if (highest_rad < -0.5) continue;
        ++above;
        std::vector<double> edges;
        fan.place(antenna, azimuth_rad, azimuth_rad, edges);
        INFO("roll " << roll_deg << ", azimuth " << azimuth_rad);
        CHECK(edges.back() >= highest_rad);
      }
    }
    CHECK(above > 40);
  }
}

// Inverted, looking down, and on its side: range falls with elevation in all or a part of a column.
TEST_CASE("Fans of turned antennas hold the ground on both sides of the lowest direction",
          "[elevation_fan]") {
  struct Case {
    double roll_deg, pitch_deg, boresight_deg;
  };
  for (const Case& of : {Case{180.0, 0.0, 3.8},
                         {0.0, -90.0, 0.0},
                         {0.0, -90.0, -3.8},
                         {0.0, -75.0, -3.8},
                         {90.0, 0.0, 0.0},
                         {-160.0, -20.0, 10.0}})
    for (const sensors::ScanSurface surface :
         {sensors::ScanSurface::plane, sensors::ScanSurface::cone}) {
      const sensors::Sensor sensor =
          turned_sensor(surface, of.roll_deg, of.pitch_deg, of.boresight_deg);
      constexpr double kAzimuth_rad = 0.2, kAntenna_m = 300.0;
      const std::vector<double> edges = edges_of(sensor, kAntenna_m, 0.0, kAzimuth_rad);
      INFO("roll " << of.roll_deg << ", pitch " << of.pitch_deg << ", cone "
                   << (surface == sensors::ScanSurface::cone));
      REQUIRE(edges.size() > 2);
      CHECK(std::is_sorted(edges.begin(), edges.end()));
      CHECK(directions_held(sensor, kAntenna_m, kAzimuth_rad, edges) > 5);
    }
}

// Straight below lies in one azimuth of a tilted antenna: the others begin beside it, lower or higher in
// elevation.
TEST_CASE("Fans of tilted antennas hold the ground of gates that begin before the ground below",
          "[elevation_fan]") {
  struct Case {
    double roll_deg, pitch_deg, boresight_deg, reach_deg, height_m;
  };
  for (const Case& of : {Case{25.0, 0.0, -35.0, 35.0, 300.0},
                         {30.0, 0.0, -40.0, 36.0, 150.0},
                         {45.0, 0.0, -40.0, 36.0, 150.0},
                         {60.0, 0.0, 0.0, 60.0, 30.0},
                         {120.0, 0.0, 0.0, 60.0, 30.0},
                         // To the antenna's own down axis, before and behind straight below.
                         {0.0, -10.0, -50.0, 40.0, 100.0},
                         {0.0, 10.0, -50.0, 40.0, 100.0},
                         {-30.0, -20.0, -50.0, 50.0, 100.0}})
    for (const sensors::ScanSurface surface :
         {sensors::ScanSurface::plane, sensors::ScanSurface::cone}) {
      sensors::Sensor sensor = turned_sensor(surface, of.roll_deg, of.pitch_deg, of.boresight_deg);
      sensor.antenna.elevation.half_power_width_rad = core::radians(40.0);
      sensor.antenna.elevation.cut_rad = core::radians(of.reach_deg);
      sensor.range.minimum_m = of.height_m / 2.0;
      sensor.range.cells = 60;
      int held = 0;
      for (const double azimuth_rad : {-0.4, 0.0, 0.2}) {
        INFO("roll " << of.roll_deg << ", pitch " << of.pitch_deg << ", azimuth " << azimuth_rad
                     << ", cone " << (surface == sensors::ScanSurface::cone));
        const std::vector<double> edges = edges_of(sensor, of.height_m, 0.0, azimuth_rad);
        CHECK(std::is_sorted(edges.begin(), edges.end()));
        held += directions_held(sensor, of.height_m, azimuth_rad, edges);
      }
      CHECK(held > 100);
    }
}

// Up to 7 deg beside the middle a gate's ends lie 7 deg higher or lower at 45 deg of bank.
TEST_CASE("Fans of tilted antennas hold both ends of the gate in all azimuths that share them",
          "[elevation_fan]") {
  struct Case {
    double roll_deg, pitch_deg, height_m;
  };
  for (const Case& of : {Case{10.0, -5.0, 60.0},
                         {30.0, 0.0, 60.0},
                         {-45.0, 0.0, 60.0},
                         {45.0, 0.0, 200.0},
                         {135.0, 0.0, 60.0},
                         {135.0, 10.0, 60.0}})
    for (const sensors::ScanSurface surface :
         {sensors::ScanSurface::plane, sensors::ScanSurface::cone})
      for (const double width_deg : {4.0, 14.0}) {
        INFO("roll " << of.roll_deg << ", pitch " << of.pitch_deg << ", " << width_deg
                     << " deg wide, cone " << (surface == sensors::ScanSurface::cone));
        sensors::Sensor sensor = turned_sensor(surface, of.roll_deg, of.pitch_deg, -10.0);
        sensor.antenna.elevation.half_power_width_rad = core::radians(20.0);
        sensor.antenna.elevation.cut_rad = core::radians(30.0);
        sensor.range.minimum_m = 300.0;
        sensor.range.cells = 80;
        const double azimuth_rad = core::radians(12.0), width_rad = core::radians(width_deg);
        const std::vector<double> edges =
            edges_of(sensor, of.height_m, 0.0, azimuth_rad, renderer::sampling_for(4.0), width_rad);
        CHECK(std::is_sorted(edges.begin(), edges.end()));
        int held = 0;
        for (const double beside_rad : {-width_rad / 2, 0.0, width_rad / 2})
          held += directions_held(sensor, of.height_m, azimuth_rad + beside_rad, edges, 1.0, 1e-3);
        CHECK(held > 100);
      }
}

TEST_CASE("Fans of few rays reach the end of the gate, whatever the number of its cells",
          "[elevation_fan]") {
  for (const double rays_per_cell : {1.0, 0.3, 0.125})
    for (const int cells : {1, 2, 11, 16, 18, 22, 24, 524}) {
      sensors::Sensor sensor = tests::hivision(8);
      sensor.range.cells = cells;
      renderer::Sampling sampling;
      sampling.rays_per_cell = rays_per_cell;
      constexpr double kAntenna_m = 40.0;
      const std::vector<double> edges = edges_of(sensor, kAntenna_m, 0.0, 0.0, sampling);
      INFO(rays_per_cell << " rays a cell, " << cells << " cells");
      REQUIRE(edges.size() > 2);
      CHECK(edges.back() >=
            -std::asin(kAntenna_m / (sensor.range.maximum_m() + sensor.range.cell_m)));
    }
}

// Elevation side lobes of an antenna that looks down reach the ground below, far before the first cell.
TEST_CASE("What is nearer than the first range cell takes one row on each side of straight below",
          "[elevation_fan]") {
  sensors::Sensor sensor = tests::hivision(8);
  sensor.scan.surface = sensors::ScanSurface::plane;
  sensor.scan.stabilised = false;
  sensor.range.minimum_m = 200.0;
  sensor.antenna.elevation.side_lobe_gain = 0.01;
  sensor.antenna.elevation.side_lobe_extent_rad = core::radians(90.0);
  constexpr double kAntenna_m = 60.0;
  for (const double pitch_deg : {-30.0, -90.0}) {
    INFO("pitch " << pitch_deg);
    const double pitch_rad = core::radians(pitch_deg);
    const std::vector<double> edges = edges_of(sensor, kAntenna_m, pitch_rad, 0.0);
    REQUIRE(edges.size() > 100);
    CHECK(std::is_sorted(edges.begin(), edges.end()));
    const auto below = [&](double elevation_rad) {
      return std::lower_bound(edges.begin(), edges.end(), elevation_rad) - edges.begin();
    };
    const auto ahead_rad = [&](double range_m) {
      return -std::asin(kAntenna_m / range_m) - pitch_rad;
    };
    const double nadir_rad = -core::kPi / 2 - pitch_rad;
    CHECK(below(ahead_rad(160.0)) - below(nadir_rad - 1e-6) == 1);
    // Behind, as far down from the nadir.
    const double behind_rad = 2.0 * nadir_rad - ahead_rad(160.0);
    if (behind_rad > edges.front()) CHECK(below(nadir_rad - 1e-6) == below(behind_rad));
    // One ray a cell from the first one on, and before it no wide row that could reach into it.
    CHECK(below(ahead_rad(200.0 + 10.0 * sensor.range.cell_m)) - below(ahead_rad(200.0)) >= 10);
    const auto first = static_cast<std::size_t>(below(ahead_rad(160.0)));
    CHECK(edges[first + 1] - edges[first] < 0.02);
  }
}
