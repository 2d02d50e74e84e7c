// What a map of a scene answers: what mirrored rays may meet, and where the ground ends.
#include "scenes/sight_map.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/errors.h"
#include "core/units.h"
#include "sensors/sensor_file.h"
#include "tests/processor_time.h"

namespace fanbeam::tests {
namespace {

sensors::Sensor shipped() {
  core::ProblemList problems;
  return sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
}

sensors::AntennaFrame pitched(const glm::dvec3& position_m, double pitch_deg) {
  const double pitch_rad = core::radians(pitch_deg);
  sensors::AntennaFrame antenna;
  antenna.position_m = position_m;
  antenna.forward = {std::cos(pitch_rad), 0.0, std::sin(pitch_rad)};
  antenna.up = {-std::sin(pitch_rad), 0.0, std::cos(pitch_rad)};
  return antenna;
}

terrain::HeightField ground_within(double half_m) {
  return terrain::make_height_field(-half_m, -half_m, half_m, half_m, 100.0);
}

terrain::PlacedMesh triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  terrain::PlacedMesh mesh;
  mesh.mesh.vertices_m = {a, b, c};
  mesh.mesh.triangles = {{0, 1, 2}};
  mesh.mesh.triangle_material = {0};
  mesh.material_of_name = {1};
  return mesh;
}

// Of 100 frames, the least of three goes.
double time_of_looking_s(const scenes::SightMap& map, const sensors::Sensor& sensor) {
  double least_s = 1e300;
  for (int go = 0; go < 3; ++go) {
    const double begin_s = processor_time_s();
    for (int frame = 0; frame < 100; ++frame)
      CHECK_FALSE(map.seen_from(pitched({frame, 0.0, 300.0}, 0.0), sensor).mirrors);
    least_s = std::min(least_s, processor_time_s() - begin_s);
  }
  return least_s;
}

}  // namespace

// It was looked for beside the fan by as much as slopes turn rays: by nothing, over level ground. A
// ray keeps its heading there, but its azimuth of an antenna that points down only until it goes up.
TEST_CASE("What level ground mirrors leaves the fan of an antenna that leans",
          "[scenes][frame_plan]") {
  sensors::Sensor sensor = shipped();
  sensor.scan.field_of_view_rad = core::radians(80.0);
  sensor.scan.columns = 320;
  const glm::dvec3 body_m(1086.0, -1738.0, 760.0);  // 58 deg to the right
  // A mirroring plain under a triangle that stands in the air.
  const scenes::SightMap map =
      scenes::SightMap(ground_within(4200.0), {},
                       {triangle(body_m + glm::dvec3(-10.0, -10.0, -60.0), body_m,
                                 body_m + glm::dvec3(10.0, 10.0, 60.0))})
          .with_mirrors({true, false});
  const sensors::AntennaFrame leaning = pitched({0.0, 0.0, 1000.0}, -60.0);
  // The ray that the ground mirrors into it is one of the fan: towards its image.
  const glm::dvec3 to_image_m = glm::dvec3(body_m.x, body_m.y, -body_m.z) - leaning.position_m;
  const auto image = sensors::angles(leaning, to_image_m, sensor);
  REQUIRE(image);
  CHECK(core::degrees(image->azimuth_rad) == Approx(40.055).epsilon(0.0).margin(0.001));
  CHECK(core::degrees(image->elevation_rad) == Approx(1.283).epsilon(0.0).margin(0.001));
  CHECK(glm::length(to_image_m) < sensor.range.maximum_m());
  CHECK(core::degrees(sensors::angles(leaning, body_m - leaning.position_m, sensor)->azimuth_rad) ==
        Approx(66.635).epsilon(0.0).margin(0.001));
  CHECK(map.seen_from(leaning, sensor).mirrored_rays_end);
  // A level antenna with the same beam has it 58 deg aside, whatever is mirrored.
  sensor.antenna.boresight_elevation_rad -= core::radians(60.0);
  const sensors::AntennaFrame level = pitched(leaning.position_m, 0.0);
  const scenes::SightMap::Seen seen = map.seen_from(level, sensor);
  CHECK(seen.mirrors);
  CHECK_FALSE(seen.mirrored_rays_end);
  // On a cone a ray 42 deg aside and 79 deg down is 78 deg aside in the horizontal.
  sensor.scan.surface = sensors::ScanSurface::cone;
  CHECK(map.seen_from(level, sensor).mirrored_rays_end);
}

TEST_CASE("A mirror off the terrain is seen from off the terrain, within range",
          "[scenes][frame_plan]") {
  const sensors::Sensor sensor = shipped();
  for (const glm::dvec3& corner_m : {glm::dvec3(5000.0, 3000.0, 0.0), glm::dvec3(5000.0, 0.0, 0.0),
                                     glm::dvec3(5000.0, -3000.0, 0.0)}) {
    const scenes::SightMap map =
        scenes::SightMap(ground_within(1000.0), {},
                         {triangle(corner_m, corner_m + glm::dvec3(10.0, 0.0, 0.0),
                                   corner_m + glm::dvec3(0.0, 10.0, 50.0))})
            .with_mirrors({false, true});
    INFO(corner_m.y);
    CHECK(map.seen_from(pitched(corner_m + glm::dvec3(-1000.0, 0.0, 50.0), 0.0), sensor).mirrors);
    // 4 km behind it.
    CHECK_FALSE(
        map.seen_from(pitched(corner_m + glm::dvec3(4010.0, 0.0, 50.0), 0.0), sensor).mirrors);
  }
}

// Of 23 times the ground each frame took 17 times as long.
TEST_CASE("What lies beyond the farthest range takes no time of a frame", "[scenes][frame_plan]") {
  const sensors::Sensor sensor = shipped();
  const auto takes_s = [&](double half_m) {
    return time_of_looking_s(
        scenes::SightMap(ground_within(half_m), {}, {}).with_mirrors({false, true}), sensor);
  };
  CHECK(takes_s(20000.0) < 4.0 * takes_s(4200.0));
}

TEST_CASE("The ground ends where the fan may pass its rim", "[scenes][frame_plan]") {
  // The fan of 23 deg to both sides is 1.5 km wide at 3.7 km.
  const sensors::Sensor sensor = shipped();
  const scenes::SightMap map(terrain::make_height_field(-3400.0, -2500.0, 4600.0, 2500.0, 100.0),
                             {}, {});
  sensors::AntennaFrame antenna = pitched({-2500.0, 0.0, 130.0}, 0.0);
  CHECK_FALSE(map.ends_within_range(antenna, sensor));
  antenna.position_m.y = 1500.0;  // 1 km from the left rim
  CHECK(map.ends_within_range(antenna, sensor));
  antenna.position_m = {1000.0, 0.0, 130.0};  // 3.6 km from the rim ahead
  CHECK(map.ends_within_range(antenna, sensor));
  // Out of sight of all ground: under it, if anywhere.
  antenna = pitched({5000.0, 0.0, 130.0}, 0.0);
  CHECK(map.ends_within_range(antenna, sensor));
}

}  // namespace fanbeam::tests
