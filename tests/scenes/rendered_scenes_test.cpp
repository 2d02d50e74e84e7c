// The shipped scenes as pictures: what they must show, as numbers. That they have not changed
// unnoticed is what tests/golden/suite.toml is for.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "renderer/frame.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "tests/scenes/shipped_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using tests::shipped_scene;

namespace {

renderer::Frame render(const scenes::Scene& scene, int frame, double rays_per_cell = 16.0) {
  return renderer::render_frame(scene.world, renderer::sampling_for(rays_per_cell), {},
                                renderer::effects_of(scene.plan, 1), scene.frame_pose(frame));
}

// B-scope grey at a place given in landing coordinates, over 3 x 1 cells: the mean for surfaces,
// the peak for things.
class Probe {
 public:
  Probe(const scenes::Scene& scene, int frame, const renderer::Frame& picture,
        const char* threshold_name)
      : scene_(scene), picture_(picture) {
    const renderer::FramePose pose = scene.frame_pose(frame);
    antenna_ =
        sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB,
                               scene.world.sensor.mounting, scene.world.sensor.scan.stabilised);
    for (const scenes::RunwayDescription& runway : scene.description.runways)
      for (const int end : {0, 1})
        if (runway.ends[end].name == threshold_name) {
          const glm::dvec3 from = scene.frame.to_local_m(runway.ends[end].pavement_end);
          const glm::dvec3 to = scene.frame.to_local_m(runway.ends[1 - end].pavement_end);
          along_ = glm::normalize(glm::dvec2(to - from));
          threshold_m_ = glm::dvec2(from) + along_ * runway.ends[end].displaced_m;
        }
  }

  double grey(double behind_m, double left_m, double above_m = 0.0) const {
    const std::array<double, 3> cells = cells_at(behind_m, left_m, above_m);
    return (cells[0] + cells[1] + cells[2]) / 3.0;
  }
  double peak(double behind_m, double left_m, double above_m) const {
    const std::array<double, 3> cells = cells_at(behind_m, left_m, above_m);
    return std::max({cells[0], cells[1], cells[2]});
  }

 private:
  std::array<double, 3> cells_at(double behind_m, double left_m, double above_m) const {
    const glm::dvec2 at =
        threshold_m_ + along_ * behind_m + glm::dvec2(-along_.y, along_.x) * left_m;
    const double ground_m = *scene_.world.surfaces().terrain()->height_at(at.x, at.y);
    const glm::dvec3 path = glm::dvec3(at, ground_m + above_m) - antenna_.position_m;
    const sensors::Sensor& sensor = scene_.world.sensor;
    const auto angles = sensors::angles(antenna_, path, sensor.scan.surface);
    const int row = sensors::range_row(sensor.range, glm::length(path));
    const int column = sensors::azimuth_column(sensor.scan, angles->azimuth_rad);
    REQUIRE(row > 0);
    REQUIRE(column >= 0);
    std::array<double, 3> cells{};
    for (int k = 0; k < 3; ++k)
      cells[static_cast<std::size_t>(k)] =
          picture_
              .bscope_grey[static_cast<std::size_t>((row - 1 + k) * sensor.scan.columns + column)];
    return cells;
  }

  const scenes::Scene& scene_;
  const renderer::Frame& picture_;
  sensors::AntennaFrame antenna_;
  glm::dvec2 threshold_m_{0.0}, along_{0.0, 1.0};
};

}  // namespace

TEST_CASE("The Braunschweig approach shows runway, lights, fence, hangars and the truck",
          "[rendered]") {
  const std::unique_ptr<scenes::Scene> scene = shipped_scene("braunschweig-26");
  // About 1000 m before the threshold.
  int frame = 0;
  while (glm::length(glm::dvec2(scene->frame_pose(frame).position_m)) > 1000.0) ++frame;
  const renderer::Frame picture = render(*scene, frame, 64.0);
  const Probe probe(*scene, frame, picture, "26");
  const double grass = probe.grey(450.0, 60.0);
  // 15 dB between smooth asphalt and grass at 3 deg: 65 grey levels; beam and shoulders leave two
  // thirds.
  CHECK(probe.grey(450.0, 0.0) < grass - 30.0);
  // The truck's flank and cab are metal, 20 dB above asphalt even with the beam's average.
  CHECK(probe.peak(600.0, -6.0, 1.5) > probe.grey(520.0, -6.0) + 40.0);
  // Hangar faces towards the approach.
  CHECK(probe.peak(925.0, 300.0, 5.0) > grass + 40.0);
  // A light bar on the approach against the grass between two bars.
  CHECK(probe.peak(-300.0, 0.0, 0.5) > probe.grey(-315.0, 0.0) + 3.0);
  // Fence along the airfield 165 m beside the centre line, against the grass 30 m inside of it.
  CHECK(probe.peak(300.0, 165.0, 1.2) > probe.grey(300.0, 120.0) + 5.0);
}

TEST_CASE("The obstacle field shows wires, poles, reflector and the shadow of the wall",
          "[rendered]") {
  const std::unique_ptr<scenes::Scene> scene = shipped_scene("obstacle-field");
  const int frame = 200;
  const renderer::Frame picture = render(*scene, frame, 64.0);
  const Probe probe(*scene, frame, picture, "36");
  const double grass = probe.grey(100.0, 120.0);
  CHECK(probe.peak(150.0, 60.0, 1.5) > grass + 60.0);                      // trihedral, 27 dBsm
  CHECK(probe.peak(-900.0, 60.0, 24.0) > probe.grey(-840.0, 60.0) + 5.0);  // wires
  CHECK(probe.peak(300.0, -90.0, 6.0) > grass + 10.0);                     // lamp pole
  CHECK(probe.grey(530.0, 200.0) < grass - 30.0);                          // behind the wall of 8 m
  CHECK(probe.peak(620.0, -180.0, 8.0) > grass + 60.0);                    // hangar front
}

TEST_CASE("At 94 GHz a shower stands bright before what it hides", "[rendered]") {
  const std::unique_ptr<scenes::Scene> scene = shipped_scene("rain-94ghz");
  const int frame = 150;
  const renderer::Frame picture = render(*scene, frame);
  const Probe probe(*scene, frame, picture, "36");
  // The shower's near border lies 380 m behind the threshold, 650 m to the right; left of the runway
  // the same distance shows grass behind light rain.
  const double near_border = probe.grey(380.0, -650.0);
  CHECK(near_border > probe.grey(380.0, 650.0) + 15.0);
  // 40 mm/h at 94 GHz: 16 dB/km one way (P.838-3), 23 dB there and back through 700 m.
  CHECK(probe.grey(1300.0, -650.0) < probe.grey(1300.0, 650.0) - 15.0);
}

TEST_CASE("Innsbruck: runway darker than the grass beside it, mountains above the horizon",
          "[rendered]") {
  const auto data = tests::shared_data("lowi-innsbruck/dem_lowi_wgs84_1arcsec.tif");
  if (!data) return;
  const std::unique_ptr<scenes::Scene> scene =
      shipped_scene("innsbruck-26", {data->parent_path().parent_path()});
  CHECK(scene->build_s <
        60.0);  // 15 s on a free machine; a hanging build is what this guards against
  int frame = 0;
  while (glm::length(glm::dvec2(scene->frame_pose(frame).position_m)) > 1000.0) ++frame;
  const renderer::Frame picture = render(*scene, frame, 32.0);
  const Probe probe(*scene, frame, picture, "26");
  CHECK(probe.grey(500.0, 0.0) < probe.grey(500.0, 60.0) - 15.0);
  const sensors::Sensor& sensor = scene->world.sensor;
  int above_horizon = 0;
  const int horizon_row = static_cast<int>(
      sensor.display.cscope_top_rad / sensor.display.cscope_span_rad * sensor.display.cscope_rows);
  for (int row = 0; row < horizon_row; ++row)
    for (int column = 0; column < sensor.scan.columns; ++column)
      if (picture.cscope_W_m3[static_cast<std::size_t>(row * sensor.scan.columns + column)] > 0.0)
        ++above_horizon;
  CHECK(above_horizon > 500);
}
