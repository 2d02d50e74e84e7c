// Antennas that are inverted, or look straight down: range does not rise with elevation there.
#include "core/pose.h"
#include "tests/renderer/converged_rays.h"

using namespace fanbeam;

namespace {

std::vector<materials::NrcsCurve> meadow_and_wall() {
  return {materials::PhongNrcs(0.0325, 0.136, 1.99), materials::PhongNrcs(0.05, 0.3, 4.0)};
}

terrain::HeightField plain() {
  return tests::ground(1500.0, 50.0, [](double, double) { return 0.0; });
}

sensors::Sensor not_stabilised() {
  sensors::Sensor sensor = tests::hivision(12);
  sensor.scan.stabilised = false;
  return sensor;
}

void check_alike(const tests::Difference& apart, double most_grey) {
  CHECK(apart.bscope_rms < most_grey);
  CHECK(apart.cscope_rms < most_grey);
  CHECK(std::abs(apart.mean_dB) < 0.1);
}

}  // namespace

TEST_CASE("An inverted antenna sees by rays, and in the reference, what it sees by slices",
          "[turned_antenna]") {
  sensors::Sensor sensor = not_stabilised();
  sensor.range.cells = 105;
  sensor.antenna.boresight_elevation_rad = core::radians(3.8);
  sensor.display.cscope_top_rad = core::radians(8.8);
  const renderer::World world = tests::world(
      sensor, plain(), meadow_and_wall(), {tests::box({-6.0, 500.0, -2.0}, {8.0, 530.0, 20.0}, 1)});
  renderer::FramePose pose = tests::level_pose(60.0);
  pose.q_NB = core::quaternion_from({core::kPi, 0.0, 0.0});
  const tests::Powers slices = tests::render(world, renderer::profile_sampling_for(64.0), pose);
  check_alike(
      tests::difference(sensor, tests::render(world, renderer::sampling_for(64.0), pose), slices),
      1.0);
  check_alike(tests::difference(
                  sensor, tests::render(world, renderer::reference_sampling(1, 4), pose), slices),
              1.0);
}

TEST_CASE("An antenna that looks straight down sees by rays and by slices before and behind it",
          "[turned_antenna]") {
  sensors::Sensor sensor = not_stabilised();
  sensor.mounting.pitch_rad = core::radians(-90.0);
  sensor.antenna.boresight_elevation_rad = 0.0;
  sensor.range.minimum_m = 900.0;
  sensor.range.cells = 30;
  sensor.display.cscope_top_rad = core::radians(8.0);
  sensor.display.cscope_span_rad = core::radians(16.0);
  sensor.display.cscope_rows = 160;
  // The second one stands across straight behind, where headings jump.
  const renderer::World world =
      tests::world(sensor, plain(), meadow_and_wall(),
                   {tests::box({-18.0, 80.0, -2.0}, {-2.0, 140.0, 40.0}, 1),
                    tests::box({-10.0, -90.0, -2.0}, {6.0, -50.0, 30.0}, 1)});
  const renderer::FramePose pose = tests::level_pose(1000.0);
  const tests::Powers rays =
      tests::render(world, renderer::finer_in_elevation(renderer::sampling_for(64.0), 4), pose);
  const tests::Powers slices = tests::render(world, renderer::profile_sampling_for(32.0), pose);
  check_alike(tests::difference(sensor, rays, slices), 2.0);
  // As bright behind as before.
  const auto half_W_m3 = [&](std::size_t first_row) {
    double sum = 0.0;
    for (std::size_t i = first_row * 12; i < (first_row + 80) * 12; ++i) sum += rays.cscope_W_m3[i];
    return sum;
  };
  CHECK(half_W_m3(80) / half_W_m3(0) == Approx(1.0).epsilon(0.0).margin(0.3));
}
