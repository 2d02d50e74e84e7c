// The profile caster against converged rays on small worlds full of difficulties.
#include "core/pose.h"
#include "tests/renderer/converged_rays.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

enum AirfieldMaterial : terrain::MaterialId { kField, kForest, kRunway, kMarking, kHouse, kRoof };

std::vector<materials::NrcsCurve> airfield_library() {
  return {materials::PhongNrcs(0.0325, 0.136, 1.99), materials::PhongNrcs(0.08, 0.05, 1.2),
          materials::PhongNrcs(0.002, 0.01, 2.5),    materials::PhongNrcs(0.1, 0.1, 1.0),
          materials::PhongNrcs(0.05, 0.3, 4.0),      materials::PhongNrcs(0.02, 0.2, 3.0)};
}

// Independent heights from post to post, 20 m between the lowest and the highest; two land covers.
// Level behind 800 m, so that no crest rises over the end of the range gate, where the fan of rays
// ends.
terrain::HeightField wooded_ground() {
  std::uint64_t post = 0;
  terrain::HeightField field = tests::ground(1000.0, 10.0, [&](double x, double y) {
    const double relief_m = std::clamp((800.0 - std::hypot(x, y)) / 10.0, 0.0, 20.0);
    return relief_m * (tests::uniform(21, ++post) - 0.5);
  });
  for (int row = 0; row < field.rows - 1; ++row)
    for (int column = 0; column < field.columns - 1; ++column)
      if ((row / 4 + column / 3) % 2 == 0) field.cell_material[field.cell(column, row)] = kForest;
  return field;
}

std::vector<terrain::SurfacePatch> paint() {
  return {terrain::rectangle_patch({5.0, 600.0}, {0.0, 1.0}, 500.0, 25.0, kRunway),
          terrain::rectangle_patch({4.0, 480.0}, {0.8, 0.6}, 40.0, 9.0, kMarking)};
}

terrain::Ring_m rectangle(const glm::dvec2& centre_m, const glm::dvec2& along, double length_m,
                          double width_m) {
  return terrain::rectangle_patch(centre_m, along, length_m, width_m, 0).outline_m;
}

std::vector<tests::Body> buildings() {
  std::vector<terrain::Prism> prisms;
  prisms.push_back(
      {rectangle({0.0, 120.0}, {0.0, 1.0}, 340.0, 80.0), {}, -30.0, 22.0});  // below us
  prisms.push_back({rectangle({-28.0, 430.0}, {0.9, 0.43589}, 34.0, 30.0),
                    {rectangle({-28.0, 430.0}, {0.9, 0.43589}, 18.0, 14.0)},
                    -30.0,
                    16.0});  // a courtyard
  prisms.push_back({rectangle({24.0, 520.0}, {1.0, 0.0}, 30.0, 20.0), {}, -30.0, 14.0});
  prisms.push_back(
      {rectangle({30.0, 527.0}, {0.8, 0.6}, 26.0, 16.0), {}, -30.0, 23.0});  // overlaps
  prisms.push_back(
      {rectangle({-12.0, 640.0}, {0.0, 1.0}, 60.0, 26.0), {}, -30.0, 2.0});  // half sunk
  prisms.push_back({rectangle({9.0, 780.0}, {0.6, 0.8}, 12.0, 12.0), {}, -30.0, 82.0});  // a tower
  std::vector<tests::Body> bodies;
  for (const terrain::Prism& prism : prisms)
    bodies.push_back(tests::building(prism, kHouse, kRoof));
  return bodies;
}

void check(const sensors::Sensor& sensor, const renderer::FramePose& pose) {
  const renderer::World world =
      tests::world(sensor, wooded_ground(), airfield_library(), buildings(), paint());
  tests::check_same_picture(tests::against_rays(world, pose));
}

renderer::FramePose rolled_pose() {
  renderer::FramePose pose = tests::level_pose(kHeight_m);
  pose.q_NB = core::quaternion_from({core::radians(10.0), core::radians(-5.0), 0.0});
  return pose;
}

}  // namespace

TEST_CASE("Rough ground, buildings and paint look as converged rays see them", "[profile]") {
  check(tests::narrow(12), tests::level_pose(kHeight_m));
}

TEST_CASE("The same under a beam that weighs all elevations alike", "[profile]") {
  // Visibility, land cover, walls and roofs alone, without the elevation pattern.
  sensors::Sensor sensor = tests::narrow(12);
  sensor.antenna.elevation = tests::even_hivision(12).antenna.elevation;
  check(sensor, tests::level_pose(kHeight_m));
}

TEST_CASE("A rolled and pitched antenna sees what its rays see", "[profile]") {
  sensors::Sensor sensor = tests::narrow(12);
  sensor.scan.stabilised = false;
  check(sensor, rolled_pose());
}

TEST_CASE("A cone scan sees what its rays see, level and tilted", "[profile]") {
  sensors::Sensor sensor = tests::narrow(12);
  sensor.scan.surface = sensors::ScanSurface::cone;
  sensor.scan.stabilised = false;
  check(sensor, tests::level_pose(kHeight_m));
  check(sensor, rolled_pose());
}

TEST_CASE("A cone scan sees the ground at its own elevation 20 deg aside", "[profile]") {
  // It is atan2(up, forward) there. With asin(up / range), a plane scan's, slices were 2 dB off
  // 20 deg aside. Columns of 1 deg: no shadows then, whose borders would show how coarse the
  // sub-columns are.
  sensors::Sensor sensor = tests::narrow(12);
  sensor.scan.columns = 41;
  sensor.scan.field_of_view_rad = core::radians(41.0);
  sensor.scan.surface = sensors::ScanSurface::cone;
  const auto hills_m = [](double x, double y) {
    return 3.0 * std::sin(x / 70.0) * std::cos(y / 90.0);
  };
  const renderer::World world =
      tests::world(sensor, tests::ground(1000.0, 10.0, hills_m), airfield_library());
  tests::check_same_picture(tests::against_rays(world, tests::level_pose(kHeight_m)));
}

TEST_CASE("On a cone rays and slices fill the first range cells 20 deg aside", "[profile]") {
  // A fan of rays placed by asin(up / range) ends 1 deg above them there and leaves them empty.
  sensors::Sensor sensor = tests::even_hivision(12);
  sensor.scan.columns = 41;
  sensor.scan.field_of_view_rad = core::radians(41.0);
  sensor.scan.surface = sensors::ScanSurface::cone;
  sensor.range.cells = 6;
  const renderer::World world = tests::world(
      sensor, tests::ground(1000.0, 50.0, [](double, double) { return 0.0; }), airfield_library());
  const renderer::FramePose pose = tests::level_pose(kHeight_m);
  const tests::Powers rays = tests::render(world, renderer::sampling_for(64.0), pose);
  const tests::Powers slices = tests::render(world, renderer::profile_sampling_for(64.0), pose);
  for (std::size_t i = 0; i < rays.bscope_W.size(); ++i) {
    INFO("cell " << i / 41 << ", column " << i % 41);
    CHECK(rays.bscope_W[i] == Approx(slices.bscope_W[i]).epsilon(0.01));
  }
}
